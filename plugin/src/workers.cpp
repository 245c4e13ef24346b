#include "workers.h"

#include <pthread.h>

#include <csignal>

namespace rg {
namespace {

// A thread begins with the signals blocked that are where it is made: all but those that it brings about
// itself.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS}) sigdelset(&all, own);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

void Workers::keep(size_t threads) {
  if (threads == asked_) return;
  asked_ = threads;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wanted_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  ends_ = false;
  const SignalsBlocked blocked;
  try {
    while (threads_.size() < threads) threads_.emplace_back([this] { serve(); });
  } catch (const std::exception&) {  // fewer will do
  }
}

void Workers::share(size_t count, const std::function<void(size_t)>& work) {
  Job job{work, count};
  std::fegetenv(&job.rounding);
  if (!threads_.empty() && count > 1) {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    ++jobs_;
    wanted_.notify_all();
  }
  take(job);
  // Who has not come by now finds nothing to do.
  std::unique_lock lock(mutex_);
  job_ = nullptr;
  left_.wait(lock, [this] { return at_work_ == 0; });
  if (job.error) std::rethrow_exception(job.error);
}

void Workers::take(Job& job) {
  for (size_t i = job.next++; i < job.count; i = job.next++) {
    try {
      job.work(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!job.error) job.error = std::current_exception();
    }
  }
}

void Workers::serve() {
  pthread_setname_np(pthread_self(), "rainglass");
  std::unique_lock lock(mutex_);
  for (uint64_t seen = 0; !ends_;) {
    wanted_.wait(lock, [&] { return ends_ || (job_ != nullptr && jobs_ != seen); });
    if (ends_) return;
    Job& job = *job_;
    seen = jobs_;
    ++at_work_;
    lock.unlock();
    std::fesetenv(&job.rounding);
    take(job);
    lock.lock();
    if (--at_work_ == 0) left_.notify_one();
  }
}

}  // namespace rg
