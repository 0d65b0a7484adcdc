#include "tools/portable_rig.h"

#include <fstream>
#include <iterator>

#include "config/base/paths.h"
#include "config/formats/gltf_uri.h"
#include "config/rig_writer.h"
#include "config/road/lane.h"
#include "visual/photometry/beam/lamp_tables.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

Result<std::string> whole_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Error{file.string(), "cannot be read"};
  return std::string{std::istreambuf_iterator<char>(stream), {}};
}

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return !file.empty() && fs::is_regular_file(file, ignored);
}

}  // namespace

Status PortableFiles::copy(const Rig& rig) {
  std::error_code failed;
  if (fs::exists(folder_, failed)) return Error{folder_.string(), "is there already; nothing is written over it"};
  const Status done = add_rig(rig);
  if (!done) fs::remove_all(folder_, failed);
  return done;
}

std::string PortableFiles::word(const fs::path& file) const {
  const auto found = names_.find(file);
  return (folder_.filename() / (found == names_.end() ? file.string() : found->second)).generic_string();
}

Status PortableFiles::add_rig(const Rig& rig) {
  if (const Status done = add_scene(rig.scene_file); !done) return done;
  if (!rig.traffic_file.empty())
    if (const Status done = add_named(rig.traffic_file, "traffic"); !done) return done;
  if (!rig.street_lamps_file.empty())
    if (const Status done = add_named(rig.street_lamps_file, "street_lamps"); !done) return done;
  if (const Status done = add_named(rig.vehicle_file, "vehicle"); !done) return done;
  if (const Status done = add_named(rig.cockpit_file, "cockpit"); !done) return done;
  if (!rig.key_file.empty()) {
    if (const Status done = add(rig.key_file, "bus"); !done) return done;
  }
  LampTables tables;
  for (const DesignConfig& design : rig.designs) {
    for (const LampConfig& lamp : design.lamps) {
      for (const SourceConfig& source : lamp.sources) {
        if (const Status done = add(source.file, "lamps"); !done) return done;
        for (const fs::path& file : {source.pixels, source.pixel_map, source.spectrum})
          if (const Status done = file.empty() ? Status(Done{}) : add(file, "lamps"); !done) return done;
        if (const Status read = tables.add(source); !read) return read.error();
        const fs::path tilt = source.file.parent_path() / tables.of(source).header.tilt;
        if (!tables.of(source).header.tilt.empty() && is_file(tilt)) {
          if (const Status done = add(tilt, "lamps"); !done) return done;
        }
      }
    }
  }
  return Done{};
}

/// Its own name where that is free, else with a number before it.
std::string PortableFiles::free_name(const fs::path& file, const std::string& below) {
  std::string name = below + "/" + file.filename().string();
  for (int number = 2; !taken_.insert(name).second; ++number)
    name = below + "/" + std::to_string(number) + "_" + file.filename().string();
  return name;
}

Status PortableFiles::add(const fs::path& file, const std::string& below) {
  if (names_.contains(file)) return Done{};
  const std::string name = free_name(file, below);
  std::error_code failed;
  fs::create_directories((folder_ / name).parent_path(), failed);
  fs::copy_file(file, folder_ / name, failed);
  if (failed) return Error{file.string(), "cannot be copied to " + (folder_ / name).string() + ": " + failed.message()};
  names_.emplace(file, name);
  return Done{};
}

/// A TOML file, and every file that a text in it names; the copy names their copies.
Status PortableFiles::add_named(const fs::path& toml, const std::string& below) {
  if (names_.contains(toml)) return Done{};
  const std::string name = free_name(toml, below);
  names_.emplace(toml, name);  // first: two cockpits may name each other
  const auto text = whole_text(toml);
  if (!text) return text.error();
  std::string copied;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t open = text->find('"', at);
    const std::size_t close = open == std::string::npos ? open : text->find_first_of("\"\n", open + 1);
    if (close == std::string::npos) {
      copied += text->substr(at);
      break;
    }
    const std::string named = text->substr(open + 1, close - open - 1);
    copied += text->substr(at, open - at);
    at = close;
    const fs::path file = resolve_path(named, toml);
    if ((*text)[close] == '\n' || !is_file(file)) {
      copied += text->substr(open, close - open);
      if ((*text)[close] == '"') copied += '"', ++at;
      continue;
    }
    if (const Status done = file.extension() == ".toml" ? add_named(file, below) : add(file, below); !done) return done;
    copied += toml_quoted(fs::path(names_.at(file)).lexically_relative(fs::path(name).parent_path()).generic_string());
    ++at;
  }
  std::error_code failed;
  fs::create_directories((folder_ / name).parent_path(), failed);
  std::ofstream stream(folder_ / name, std::ios::binary);
  stream << copied;
  if (!stream.flush()) return Error{(folder_ / name).string(), "cannot be written"};
  return Done{};
}

/// glTF may keep buffers, pictures and photometry in files beside it; the lane lies beside it too. They keep their names.
Status PortableFiles::add_scene(const fs::path& scene) {
  if (const Status done = add(scene, "scene"); !done) return done;
  std::set<fs::path> beside{lane_file_of(scene).filename()};
  for (const fs::path& file : files_beside(scene)) beside.insert(file);
  for (const fs::path& name : beside) {
    const fs::path file = (scene.parent_path() / name).lexically_normal();
    if (!is_file(file) || name.is_absolute() || *name.begin() == "..") continue;
    std::error_code failed;
    const fs::path to = folder_ / "scene" / name;
    fs::create_directories(to.parent_path(), failed);
    fs::copy_file(file, to, failed);
    if (failed) return Error{file.string(), "cannot be copied to " + to.string() + ": " + failed.message()};
    names_.emplace(file, "scene/" + name.generic_string());
  }
  return Done{};
}

}  // namespace phare
