// phare-make-scene: writes the scenes that phare drives through, their lanes and lamps, and road users. Same bytes each
// run.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "config/base/result.h"
#include "config/empty_values.h"
#include "config/finite_numbers.h"
#include "tools/scene/glb_writer.h"
#include "tools/scene/lane_files.h"
#include "tools/scene/parts.h"
#include "tools/scene/path.h"

namespace {

using phare::Done;
using phare::Error;
using phare::Status;

/// Whole or not at all: written beside the target, then renamed.
Status write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream out(part, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code failure;
  if (!out) {
    std::filesystem::remove(part, failure);
    return Error{path.string(), "cannot be written"};
  }
  std::filesystem::rename(part, path, failure);
  if (failure) return Error{path.string(), failure.message()};
  return Done{};
}

Status write_scene(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{folder.string(), failure.message()};

  const phare::scene::Alignment road;
  phare::scene::Model model;
  phare::scene::add_road(model, road);
  phare::scene::add_furniture(model, road);
  phare::scene::add_plants(model, road);
  phare::scene::add_things(model, road);
  phare::scene::add_people(model, road);

  phare::scene::Model users;
  phare::scene::add_road_users(users);

  for (const auto& [name, text] : phare::scene::luminaire_files())
    if (auto s = write_file(folder / name, text); !s) return s;
  for (const auto& [name, made] : {std::pair<std::string, phare::scene::MadeScene>("town", phare::scene::make_town()),
                                   {"motorway", phare::scene::make_motorway()},
                                   {"tunnel", phare::scene::make_tunnel()}}) {
    if (auto s = write_file(folder / (name + ".glb"), phare::scene::glb_bytes(made.model)); !s) return s;
    if (auto s = write_file(folder / (name + "_lane.csv"), made.lane_csv); !s) return s;
    if (made.street_lamps.empty()) continue;
    if (auto s = write_file(folder / (name + "_lamps.toml"), made.street_lamps); !s) return s;
  }
  if (auto s = write_file(folder / "road_users.glb", phare::scene::glb_bytes(users)); !s) return s;
  if (auto s = write_file(folder / "country_road.glb", phare::scene::glb_bytes(model)); !s) return s;
  if (auto s = write_file(folder / "country_road_lane.csv", phare::scene::lane_csv(road)); !s) return s;
  return write_file(folder / "country_road_places.json", phare::scene::places_json(road));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Makes the scenes: a country road of 1.8 km with bends, crest, dip and what stands beside it; a town street with "
      "its lamps; a motorway; a tunnel."};
  app.footer("Example:\n  phare-make-scene --out build/scenes");
  std::filesystem::path folder;
  app.add_option("--out", folder, "folder for country_road.glb, town.glb, motorway.glb, tunnel.glb, what belongs to each, and road_users.glb")
      ->required();
  phare::take_finite_numbers_only(app);
  phare::refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::fprintf(stderr, "%s\n", e.what());
    return phare::kExitBadInput;
  }
  if (auto status = write_scene(folder); !status) {
    std::fprintf(stderr, "%s\n", status.error().text().c_str());
    return phare::kExitBadInput;
  }
  return phare::kExitDone;
}
