// The pictures of a drive's frames: files, a hash over all of them, and thumbnails for the contact sheet.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "visual/image/contact_sheet.h"
#include "visual/process/picture_writer.h"

namespace phare {

class FramePictures {
 public:
  /// From now on beside the drawing: real time waits for no disk. While busy() the next one would have to wait.
  void write_beside() { writer_ = std::make_unique<PictureWriter>(); }
  bool busy() const { return writer_ && writer_->busy(); }
  /// What came of it, and of those before that were written beside the drawing since.
  std::vector<Status> keep(std::filesystem::path file, Image8 image, std::string label);
  /// Waits for all; what came of them.
  std::vector<Status> finish() { return writer_ ? writer_->finish() : std::vector<Status>{}; }

  /// One number over the pixels of every kept picture in order (FNV-1a, 64 bit, two pixels at a time): equal drives
  /// give equal numbers. Of those that have been written.
  std::uint64_t hash() const { return made_->hash; }
  std::uint64_t kept() const { return kept_; }
  /// Once finish() has waited: at most so many, evenly chosen.
  std::vector<LabelledImage> thumbnails(std::size_t most) const { return made_->thumbnails.pick(most); }

 private:
  /// By the thread that writes.
  struct Made {
    std::atomic<std::uint64_t> hash = 0xcbf29ce484222325ull;
    Thumbnails thumbnails{};

    void see(const Image8& image, const std::string& label);
  };

  std::shared_ptr<Made> made_ = std::make_shared<Made>();
  std::unique_ptr<PictureWriter> writer_;
  std::uint64_t kept_ = 0;
};

}  // namespace phare
