// A loop whose turns do not know of each other, on all processors.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace phare {

namespace detail {
/// Calls `work` here, and meanwhile on those of the process's waiting threads that are free, `others` at most; returns
/// when all calls have. Throws what one of them threw. There is a thread for each processor but one, begun when first
/// wanted; where no more can be had, those there are do it.
void at_once(std::size_t others, const std::function<void()>& work);
}  // namespace detail

/// Calls work(0) to work(count - 1), each once, and waits for all; throws what one of them threw. To wake another
/// processor takes some hundredths of a millisecond, so a turn should be worth more.
template <typename Work>
void on_all_cores(std::size_t count, const Work& work) {
  if (count == 0) return;
  std::atomic<std::size_t> next = 0;
  detail::at_once(count - 1, [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  });
}

}  // namespace phare
