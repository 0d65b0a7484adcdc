// The generated country road as it is read back: what stands on it, how it is shaped, what it costs. And foreign glTF
// files: read, or refused with a reason.
#include "visual/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

const Scene& country_road() {
  static const Scene scene = [] {
    auto read = read_scene(fs::path(scene_dir()) / "country_road.glb");
    if (!read) ADD_FAILURE() << read.error().text();
    return read ? *read : Scene{};
  }();
  return scene;
}

struct LaneRow {
  double s_m, x_m, y_m, z_m, heading_rad, curvature_1pm;
};

const std::vector<LaneRow>& lane() {
  static const std::vector<LaneRow> rows = [] {
    std::ifstream in(fs::path(scene_dir()) / "country_road_lane.csv");
    std::vector<LaneRow> read;
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm");
    LaneRow r{};
    char comma = 0;
    while (in >> r.s_m >> comma >> r.x_m >> comma >> r.y_m >> comma >> r.z_m >> comma >> r.heading_rad >> comma >>
           r.curvature_1pm) {
      read.push_back(r);
    }
    return read;
  }();
  return rows;
}

glm::dvec3 corner(const Scene& scene, const SceneChunk& chunk, std::uint32_t i) {
  return chunk.origin_m +
         glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i]].position_m);
}

/// Height of the uppermost triangle of the kind above or below (x, y).
std::optional<double> height_of(const Scene& scene, const std::string& kind, double x, double y) {
  std::optional<double> height;
  for (const SceneChunk& chunk : scene.chunks) {
    if (!chunk.node.starts_with(kind)) continue;
    if (x < chunk.low_m.x || x > chunk.high_m.x || y < chunk.low_m.y || y > chunk.high_m.y) continue;
    for (std::uint32_t i = 0; i < chunk.index_count; i += 3) {
      const glm::dvec3 a = corner(scene, chunk, i), b = corner(scene, chunk, i + 1), c = corner(scene, chunk, i + 2);
      const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      if (std::abs(area) < 1e-9) continue;
      const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
      const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
      if (u < -1e-6 || v < -1e-6 || u + v > 1.0 + 1e-6) continue;
      const double z = a.z + u * (b.z - a.z) + v * (c.z - a.z);
      if (!height || z > *height) height = z;
    }
  }
  return height;
}

TEST(CountryRoad, GivesTheSameBytesEachRun) {
  const fs::path folder = fs::path(testing::TempDir()) / "phare_scene_again";
  fs::remove_all(folder);
  const std::string command = std::string("'") + program("phare-make-scene") + "' --out '" + folder.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  for (const char* name : {"country_road.glb", "country_road_lane.csv", "country_road_places.json"}) {
    const std::string built = bytes_of(fs::path(scene_dir()) / name);
    EXPECT_GT(built.size(), 1000u) << name;
    EXPECT_TRUE(built == bytes_of(folder / name)) << name;
  }
  fs::remove_all(folder);
}

TEST(CountryRoad, LaneIsLongSmoothAndMeasuredInMetres) {
  ASSERT_GE(lane().size(), 1501u);
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i + 1 < lane().size(); ++i) {
    const LaneRow &a = lane()[i], &b = lane()[i + 1];
    ASSERT_NEAR(b.s_m - a.s_m, 1.0, 1e-9);
    // Arc length in the plane, so that s drives the lane at its own pace. A chord of 1 m at R = 180 m is 1.3e-6 m
    // short.
    EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), 1.0, 1e-5);
    EXPECT_NEAR(b.heading_rad - a.heading_rad, 0.5 * (a.curvature_1pm + b.curvature_1pm), 2e-6);
    EXPECT_LT(std::abs(b.curvature_1pm - a.curvature_1pm), 1.2e-4);  // no steering jerk: the bend grows over 80 m
    EXPECT_LT(std::abs(b.z_m - a.z_m), 0.09);
    left = std::max(left, a.curvature_1pm), right = std::min(right, a.curvature_1pm);
  }
  EXPECT_NEAR(1.0 / left, 201.6, 0.5);    // R = 200 m, the lane outside
  EXPECT_NEAR(1.0 / right, -178.4, 0.5);  // R = 180 m, the lane inside
}

TEST(CountryRoad, HasCrestAndDip) {
  const auto places = nlohmann::json::parse(bytes_of(fs::path(scene_dir()) / "country_road_places.json"));
  const auto height = [&](double s) { return lane()[static_cast<std::size_t>(s)].z_m; };
  const double top = places["crest_top"]["s_m"], bottom = places["dip_bottom"]["s_m"];
  EXPECT_GT(height(top) - height(top - 150.0), 4.5);
  EXPECT_GT(height(top) - height(top + 140.0), 4.0);
  EXPECT_LT(height(bottom) - height(places["dip"]["end_s_m"]), -3.0);
  // Tight enough to lift the beam off the road: vertical radius by second difference over 20 m.
  const auto radius = [&](double s) { return 100.0 / (height(s - 10.0) - 2.0 * height(s) + height(s + 10.0)); };
  EXPECT_LT(radius(top), -400.0);
  EXPECT_GT(radius(top), -800.0);
  EXPECT_GT(radius(bottom), 400.0);
  EXPECT_LT(radius(bottom), 800.0);
}

TEST(CountryRoad, LaneLiesOnTheRoadAndMarkingsJustAboveIt) {
  for (std::size_t i = 0; i < lane().size(); i += 7) {
    const LaneRow& row = lane()[i];
    const auto z = height_of(country_road(), "road", row.x_m, row.y_m);
    ASSERT_TRUE(z.has_value()) << "no road at s = " << row.s_m;
    EXPECT_NEAR(*z, row.z_m, 0.01) << "s = " << row.s_m;
    // The right edge line lies 1.685 m right of the lane's centre.
    const double x = row.x_m + 1.685 * std::sin(row.heading_rad), y = row.y_m - 1.685 * std::cos(row.heading_rad);
    const auto line = height_of(country_road(), "marking", x, y), road = height_of(country_road(), "road", x, y);
    ASSERT_TRUE(line && road) << "s = " << row.s_m;
    EXPECT_GT(*line - *road, 0.004) << "s = " << row.s_m;
    EXPECT_LT(*line - *road, 0.010) << "s = " << row.s_m;
  }
}

TEST(CountryRoad, KeepsTheLaneClear) {
  const std::set<std::string> flat{"road", "ground", "marking"};
  for (const SceneChunk& chunk : country_road().chunks) {
    const std::string kind = chunk.node.substr(0, chunk.node.find('_'));
    if (flat.contains(kind)) continue;
    const glm::dvec3 middle = 0.5 * (chunk.low_m + chunk.high_m);
    for (const LaneRow& row : lane()) {
      if (std::hypot(row.x_m - middle.x, row.y_m - middle.y) > 60.0) continue;
      for (std::uint32_t i = 0; i < chunk.vertex_count; ++i) {
        const glm::dvec3 p = chunk.origin_m + glm::dvec3(country_road().vertices[chunk.first_vertex + i].position_m);
        if (p.z - row.z_m > 4.0) continue;  // leaves over the road are welcome
        ASSERT_GT(std::hypot(p.x - row.x_m, p.y - row.y_m), 1.2)
            << chunk.node << " stands in the lane at s = " << row.s_m;
      }
    }
  }
}

TEST(CountryRoad, HasEverythingThatStandsBesideARoad) {
  std::map<std::string, std::set<std::string>> nodes;
  for (const SceneChunk& chunk : country_road().chunks)
    nodes[chunk.node.substr(0, chunk.node.find('_'))].insert(chunk.node);
  for (const char* kind : {"road", "ground", "marking", "post", "rail", "sign", "tree", "bush", "barn", "car",
                           "pedestrian", "cyclist", "fence", "bale"}) {
    EXPECT_FALSE(nodes[kind].empty()) << kind;
  }
  EXPECT_EQ(nodes["pedestrian"].size(), 2u);
  EXPECT_GE(nodes["sign"].size(), 10u);
  EXPECT_GE(nodes["tree"].size(), 40u);
  EXPECT_LE(country_road().materials.size(), 45u);
  double sheeting = 0.0, marking = 0.0;
  bool asphalt = false, paint = false, foliage = false;
  for (const SceneMaterial& m : country_road().materials) {
    if (m.retro.kind == RetroKind::kSheeting) sheeting = std::max(sheeting, sheeting_r_a(m.retro, 0.33, 5.0));
    marking = std::max(marking, m.retro.r_l_mcd_per_lx_m2);
    asphalt |= m.surface == Surface::kAsphalt, paint |= m.surface == Surface::kPaint,
        foliage |= m.surface == Surface::kFoliage;
  }
  EXPECT_NEAR(sheeting, 180.0, 0.01);  // EN 12899-1 RA2 white
  EXPECT_EQ(marking, 200.0);           // EN 1436 R4
  EXPECT_TRUE(asphalt && paint && foliage);
}

TEST(CountryRoad, StaysWithinItsTriangles) {
  std::size_t whole = 0;
  for (const SceneChunk& chunk : country_road().chunks) whole += chunk.index_count / 3;
  EXPECT_LE(whole, 150'000u);
  EXPECT_GE(whole, 40'000u);
  for (std::size_t i = 0; i + 300 < lane().size(); i += 25) {  // what stands within 150 m of a point 150 m ahead
    const LaneRow &eye = lane()[i], &middle = lane()[i + 150];
    std::size_t seen = 0;
    for (const SceneChunk& chunk : country_road().chunks) {
      const glm::dvec3 at = 0.5 * (chunk.low_m + chunk.high_m);
      if (std::hypot(at.x - middle.x_m, at.y - middle.y_m) >= 150.0) continue;
      // From 45 m on no more than half of the leaves are drawn (FarMesh.LeavesAreThinnedByTheirSize).
      const bool thinned = country_road().materials[chunk.material].surface == Surface::kFoliage &&
                           std::hypot(at.x - eye.x_m, at.y - eye.y_m) > 60.0;
      seen += chunk.index_count / (thinned ? 6 : 3);
    }
    EXPECT_LE(seen, 40'000u) << "from s = " << i;
  }
}

void expect_sound(const Scene& scene) {
  for (const SceneChunk& chunk : scene.chunks) {
    ASSERT_LT(chunk.material, scene.materials.size());
    ASSERT_LE(chunk.first_index + chunk.index_count, scene.indices.size());
    ASSERT_LE(chunk.first_vertex + chunk.vertex_count, scene.vertices.size());
    ASSERT_EQ(chunk.index_count % 3, 0u);
    ASSERT_GT(chunk.index_count, 0u);
    for (std::uint32_t i = 0; i < chunk.index_count; ++i) {
      ASSERT_LT(scene.indices[chunk.first_index + i], chunk.vertex_count);
    }
    for (std::uint32_t i = 0; i < chunk.vertex_count; ++i) {
      const SceneVertex& v = scene.vertices[chunk.first_vertex + i];
      ASSERT_NEAR(glm::length(v.normal), 1.0f, 1e-4f) << chunk.node;
      const glm::dvec3 p = chunk.origin_m + glm::dvec3(v.position_m);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(p[axis], chunk.low_m[axis] - 1e-4) << chunk.node;
        ASSERT_LE(p[axis], chunk.high_m[axis] + 1e-4) << chunk.node;
      }
    }
  }
}

TEST(CountryRoad, IsSoundAndCutIntoChunks) {
  expect_sound(country_road());
  EXPECT_TRUE(country_road().content_hash.starts_with("sha256:"));
  for (const SceneChunk& chunk : country_road().chunks) {
    EXPECT_LE(chunk.high_m.x - chunk.low_m.x, 100.0) << chunk.node;
    EXPECT_LE(chunk.high_m.y - chunk.low_m.y, 100.0) << chunk.node;
  }
}

TEST(CountryRoad, RoadAndGroundLookUp) {
  for (const SceneChunk& chunk : country_road().chunks) {
    if (!chunk.node.starts_with("road") && !chunk.node.starts_with("ground") && !chunk.node.starts_with("marking"))
      continue;
    for (std::uint32_t i = 0; i < chunk.index_count; i += 3) {
      const glm::dvec3 a = corner(country_road(), chunk, i), b = corner(country_road(), chunk, i + 1),
                       c = corner(country_road(), chunk, i + 2);
      ASSERT_GT(glm::cross(b - a, c - a).z, 0.0) << chunk.node;
    }
  }
}

// ---- small files of our own

fs::path write_gltf(const std::string& name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / name;
  std::ofstream(file) << text;
  return file;
}

/// One triangle (0,0,0) (1,0,0) (0,1,0), no normals; `node` and `material` are JSON.
std::string triangle_gltf(const std::string& node, const std::string& material) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[)" + material +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(ReadScene, AppliesNodesAxesAndMaterials) {
  const auto scene = read_scene(write_gltf(
      "phare_triangle.gltf",
      triangle_gltf(R"({"name":"barn","mesh":0,"translation":[10,20,30],"scale":[2,2,2]})",
                    R"({"name":"m","doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]},)"
                    R"("extras":{"phare":{"surface":"grass","retroreflection_cd_per_lx_m2":7}}})")));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_sound(*scene);
  ASSERT_EQ(scene->chunks.size(), 1u);
  EXPECT_EQ(scene->chunks[0].node, "barn");
  EXPECT_EQ(corner(*scene, scene->chunks[0], 0), glm::dvec3(10, -30, 20));
  EXPECT_EQ(corner(*scene, scene->chunks[0], 2), glm::dvec3(10, -30, 22));
  EXPECT_EQ(scene->vertices[0].normal, glm::vec3(0, -1, 0));  // glTF +z is our -y
  ASSERT_EQ(scene->materials.size(), 1u);
  EXPECT_EQ(scene->materials[0].reflectance, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene->materials[0].surface, Surface::kGrass);
  EXPECT_EQ(scene->materials[0].retro.kind, RetroKind::kSheeting);
  EXPECT_NEAR(sheeting_r_a(scene->materials[0].retro, 0.33, 5.0), 7.0, 1e-4);
  EXPECT_TRUE(scene->materials[0].double_sided);
}

TEST(ReadScene, MirroredNodeStaysRightSideOut) {
  const auto scene = read_scene(write_gltf("phare_mirror.gltf", triangle_gltf(R"({"mesh":0,"scale":[-1,1,1]})", "{}")));
  ASSERT_TRUE(scene) << scene.error().text();
  // The face looked along glTF +z; mirrored in x it still does.
  EXPECT_EQ(scene->vertices[0].normal, glm::vec3(0, -1, 0));
}

TEST(ReadScene, RefusesWhatIsWrongWithAReason) {
  const auto reason = [](const std::string& node, const std::string& material) {
    const auto scene = read_scene(write_gltf("phare_wrong.gltf", triangle_gltf(node, material)));
    return scene ? std::string("was read") : scene.error().text();
  };
  const std::string node = R"({"mesh":0})";
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"surface":"gras"}}})").find("unknown surface 'gras'"),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"retroreflection_cd_per_lx_m2":-1}}})").find("retroreflection"),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"retro":"EN 1436 R9"}}})").find("EN 1436 R"), std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"retro":4}}})").find("retro"), std::string::npos);
  EXPECT_NE(
      reason(node, R"({"extras":{"phare":{"retro":"EN 1436 R3","retroreflection_cd_per_lx_m2":4}}})").find("marking"),
      std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"retroreflection_mcd_per_lx_m2":-4}}})").find("mcd"),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":3}})").find("phare"), std::string::npos);
  EXPECT_NE(reason(node, R"({"extras":{"phare":{"retrro":"EN 1436 R3"}}})").find("did you mean \"retro\""),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"pbrMetallicRoughness":{"baseColorFactor":[2,0,0,1]}})").find("0 … 1"), std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"translation":[1e30,0,0]})", "{}").find("1e8"), std::string::npos);
  EXPECT_NE(reason(R"({"mesh":5})", "{}").find("mesh"), std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"translation":[0,3]})", "{}").find("nodes[0]: translation has 2 numbers, not 3"),
            std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"scale":3})", "{}").find("scale is no array"), std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"name":"barn","rotation":[0,0,1]})", "{}").find("\"barn\": rotation has 3"),
            std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"matrix":[1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1]})", "{}").find("last row"),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.1,0.1]}})").find("has 3 numbers, not 4"),
            std::string::npos);
  EXPECT_NE(reason(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"scale":[2,2,2]})", "{}").find("both"),
            std::string::npos);
  for (const char* no_turn : {"[0,0,0,2]", "[1e200,0,0,1]"})
    EXPECT_NE(reason(std::string(R"({"mesh":0,"rotation":)") + no_turn + "}", "{}").find("no unit quaternion"),
              std::string::npos)
        << no_turn;
  for (const char* no_light : {"[-1,0,0]", "[0,5,0]"})
    EXPECT_NE(reason(node, std::string(R"({"emissiveFactor":)") + no_light + "}").find("emissiveFactor is outside"),
              std::string::npos)
        << no_light;
  EXPECT_NE(reason(node, R"({"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e12}}})")
                .find("emissiveStrength is outside"),
            std::string::npos);
  EXPECT_NE(reason(node, R"({"alphaMode":"blend"})").find("alphaMode is \"blend\""), std::string::npos);
  EXPECT_NE(
      reason(node, R"({"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-4}}})").find("below 0"),
      std::string::npos);
  EXPECT_FALSE(read_scene("no_such_scene.glb"));
  std::string whole = bytes_of(fs::path(scene_dir()) / "country_road.glb");
  whole[4] = 1;
  const auto old = read_scene(write_gltf("phare_old.glb", whole));
  EXPECT_NE((old ? "was read" : old.error().text()).find("GLB of version 1"), std::string::npos);
  whole[4] = 2;
  for (const double part : {0.0, 1e-6, 1e-5, 0.01, 0.5, 0.999}) {  // cut off anywhere
    const auto cut = write_gltf("phare_cut.glb",
                                whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    EXPECT_FALSE(read_scene(cut)) << part;
  }
}

TEST(ReadScene, ReadsOrRefusesTheSharedSamples) {
  const fs::path folder = fs::path(shared_data_dir()) / "gltf";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no " << folder.string() << ", the shared glTF samples";
  std::size_t read = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    const auto scene = read_scene(entry.path());
    if (scene) {
      ++read;
      expect_sound(*scene);
    } else {
      ++refused;
      EXPECT_FALSE(scene.error().reason.empty()) << entry.path();
      EXPECT_NE(scene.error().text().find(entry.path().filename().string()), std::string::npos) << scene.error().text();
    }
  }
  EXPECT_GT(read, 10u);
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("refused", static_cast<int>(refused));
}

}  // namespace
}  // namespace phare
