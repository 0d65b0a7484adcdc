#include "config/base/on_all_cores.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace phare {
namespace {

/// Threads that wait for work and never end.
class Helpers {
 public:
  void at_once(std::size_t others, const std::function<void()>& work) {
    Job job{work};
    others = begin_threads(others);
    {
      const std::lock_guard lock(mutex_);
      waiting_.insert(waiting_.end(), others, &job);
    }
    for (std::size_t i = 0; i < others; ++i) wanted_.notify_one();
    std::exception_ptr thrown;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    std::erase(waiting_, &job);  // by the time all is done nobody need begin
    done_.wait(lock, [&] { return job.calls == 0; });
    if (!thrown) thrown = job.thrown;
    if (thrown) std::rethrow_exception(thrown);
  }

 private:
  struct Job {
    const std::function<void()>& work;
    std::size_t calls = 0;  ///< that have begun and not ended
    std::exception_ptr thrown{};
  };

  /// How many of so many there are.
  std::size_t begin_threads(std::size_t wanted) {
    static const std::size_t most = std::max(1u, std::thread::hardware_concurrency()) - 1;  // a file is read for it
    wanted = std::min(wanted, most);
    const std::lock_guard lock(mutex_);
    try {
      for (; threads_ < wanted; ++threads_) std::thread([this] { help(); }).detach();
    } catch (const std::system_error&) {  // no more can be had
    }
    return std::min(wanted, threads_);
  }

  void help() {
    std::unique_lock lock(mutex_);
    while (true) {
      wanted_.wait(lock, [this] { return !waiting_.empty(); });
      Job& job = *waiting_.front();
      waiting_.pop_front();
      ++job.calls;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        job.work();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown) job.thrown = thrown;
      if (--job.calls == 0) done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wanted_, done_;
  std::deque<Job*> waiting_;
  std::size_t threads_ = 0;
};

}  // namespace

void detail::at_once(std::size_t others, const std::function<void()>& work) {
  static Helpers& helpers = *new Helpers;  // its threads wait on it until the process is gone
  helpers.at_once(others, work);
}

}  // namespace phare
