#include "visual/process/picture_writer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace phare {

PictureWriter::PictureWriter() : thread_([this] { work(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool PictureWriter::busy() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size() >= kMostWaiting;
}

std::vector<Status> PictureWriter::take(std::function<Status()> write) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting; });
  waiting_.push_back(std::move(write));
  changed_.notify_all();
  return std::exchange(done_, {});
}

std::vector<Status> PictureWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && !writing_; });
  return std::exchange(done_, {});
}

void PictureWriter::work() {
  // After the frames: of a thread, on Linux. Where it is not granted, nothing is lost but evenness.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 19);
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    std::function<Status()> write = std::move(waiting_.front());
    waiting_.pop_front();
    writing_ = true;
    changed_.notify_all();
    lock.unlock();
    Status written = write();
    write = nullptr;  // with its picture
    lock.lock();
    writing_ = false;
    done_.push_back(std::move(written));
    changed_.notify_all();
  }
}

}  // namespace phare
