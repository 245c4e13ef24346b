// An instance's own threads, which take part in work that comes in pieces.
#pragma once

#include <atomic>
#include <cfenv>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rg {

// [thread: one at a time] None of the host's signals come to its threads, and they round as the caller does.
class Workers {
 public:
  Workers() = default;
  ~Workers() { keep(0); }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // So many from now on, or as many as the system gives.
  void keep(size_t threads);
  size_t threads() const { return threads_.size(); }

  // work(i) once for each i < count, in any order, here and on the threads at once; returns when all are
  // done. Rethrows what one of them threw, after the others.
  void share(size_t count, const std::function<void(size_t)>& work);

 private:
  struct Job {
    const std::function<void(size_t)>& work;
    size_t count;
    std::fenv_t rounding{};
    std::atomic<size_t> next = 0;
    std::exception_ptr error{};  // the first, under mutex_
  };
  void serve();
  void take(Job& job);

  std::mutex mutex_;
  std::condition_variable wanted_, left_;
  Job* job_ = nullptr;  // none: nothing to do
  uint64_t jobs_ = 0;   // so far
  size_t at_work_ = 0;  // threads that have a job in hand
  bool ends_ = false;
  size_t asked_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace rg
