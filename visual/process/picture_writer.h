// Writes pictures beside the drawing, in a thread of low priority: encoding a PNG takes longer than a frame may.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "config/base/result.h"

namespace phare {

class PictureWriter {
 public:
  PictureWriter();
  ~PictureWriter();

  /// A picture that came now would have to wait.
  bool busy() const;
  /// `write` is what is to be done with one, after those before it. Waits while busy. What came of the pictures before.
  std::vector<Status> take(std::function<Status()> write);
  /// Waits for all; what came of them.
  std::vector<Status> finish();

 private:
  void work();

  static constexpr std::size_t kMostWaiting = 2;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<Status()>> waiting_;
  std::vector<Status> done_;
  bool writing_ = false, ends_ = false;
  std::thread thread_;
};

}  // namespace phare
