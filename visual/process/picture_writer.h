// Writes pictures beside the drawing, in a thread of low priority: encoding a PNG takes longer than a frame may.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "visual/image/image.h"

namespace phare {

class PictureWriter {
 public:
  PictureWriter();
  ~PictureWriter();

  /// A picture that came now would have to wait.
  bool busy() const;
  /// Waits while busy. What came of the pictures before.
  std::vector<Status> take(std::filesystem::path file, Image8 image);
  /// Waits for all; what came of them.
  std::vector<Status> finish();

 private:
  void work();

  static constexpr std::size_t kMostWaiting = 2;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<std::filesystem::path, Image8>> waiting_;
  std::vector<Status> done_;
  bool writing_ = false, ends_ = false;
  std::thread thread_;
};

}  // namespace phare
