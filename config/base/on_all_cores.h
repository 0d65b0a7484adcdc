// A loop whose turns do not know of each other, on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace phare {

/// Calls work(0) to work(count - 1), each once, and waits for all; throws what one of them threw. Threads are begun for
/// it, so a turn should be worth some tenths of a millisecond.
template <typename Work>
void on_all_cores(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::future<void>> others;
  const std::size_t at_once = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
  try {
    while (others.size() + 1 < at_once) others.push_back(std::async(std::launch::async, turns));
  } catch (const std::system_error&) {  // no more threads can be had: those there are do it
  }
  turns();
  for (std::future<void>& other : others) other.get();
}

}  // namespace phare
