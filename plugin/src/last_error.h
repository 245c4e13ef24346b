// What last_error() tells. update's thread and the GL thread may fail at the same time, so each thread has
// its own text.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace rg {

class LastError {
 public:
  void set(const char* text) {
    const std::lock_guard lock(texts_lock_);
    if (texts_.size() >= kMostThreads) texts_.clear();
    texts_[std::this_thread::get_id()] = {text, true};
    newest_ = text;
  }

  // Of this thread's last failed call; where it had none, of the last one anywhere. Valid until this thread's
  // next call.
  const char* get() {
    const std::lock_guard lock(texts_lock_);
    Text& mine = texts_[std::this_thread::get_id()];
    if (!mine.own) mine.text = newest_;
    return mine.text.c_str();
  }

 private:
  static constexpr size_t kMostThreads =
      256;  // a host that starts a thread for each job leaves no more behind
  struct Text {
    std::string text;
    bool own = false;
  };
  std::mutex texts_lock_;
  std::map<std::thread::id, Text> texts_;
  std::string newest_;
};

}  // namespace rg
