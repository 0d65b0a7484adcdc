// unit: the library of surfaces: its entries, the words that find them, and what is wrong in one.
#include "visual/scene/material_library.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "visual/scene/retro.h"

namespace phare {
namespace {

TEST(MaterialLibrary, EveryEntryIsReadAndHasASource) {
  const Result<MaterialLibrary> library = MaterialLibrary::read();
  ASSERT_TRUE(library) << library.error().text();
  EXPECT_GT(library->all().size(), 20u);
  for (const LibraryMaterial& material : library->all()) EXPECT_GT(material.source.size(), 8u) << material.name;
}

TEST(MaterialLibrary, WordsOfNamesAreTakenWhole) {
  const Result<MaterialLibrary> library = MaterialLibrary::read();
  ASSERT_TRUE(library) << library.error().text();
  const auto fitting = [&](const char* name) {
    const LibraryMaterial* found = library->fitting(name);
    return found == nullptr ? std::string("none") : found->name;
  };
  EXPECT_EQ(fitting("Road_01"), "asphalt");
  EXPECT_EQ(fitting("M_AsphaltWet.003"), "asphalt");
  EXPECT_EQ(fitting("concreteWall"), "concrete");
  EXPECT_EQ(fitting("GRASS"), "grass");
  EXPECT_EQ(fitting("sign_post"), "galvanised steel");  // what stands first in the file
  EXPECT_EQ(fitting("TrafficSign"), "sign sheeting RA2 white");
  EXPECT_EQ(fitting("sign_diamondgrade"), "sign sheeting RA2 white");  // what stands first, again
  EXPECT_EQ(fitting("Microprismatic_01"), "sign sheeting RA3 white");
  EXPECT_EQ(fitting("redreflector"), "post reflector red");
  EXPECT_EQ(fitting("headlight_reflector"), "none") << "the bowl of a lamp sends nothing back";
  EXPECT_EQ(fitting("StructuredMarking"), "road marking");
  EXPECT_EQ(fitting("structuredmarking"), "road marking type II");
  EXPECT_EQ(fitting("signal"), "none");
  EXPECT_EQ(fitting("broad"), "none");
  EXPECT_EQ(fitting(""), "none");
}

TEST(MaterialLibrary, ReflectorsAndMarkingsHaveTheFiguresOfTheirClasses) {
  const Result<MaterialLibrary> library = MaterialLibrary::read();
  ASSERT_TRUE(library) << library.error().text();
  const auto retro = [&](const char* name) {
    const auto found = library->named(name);
    EXPECT_TRUE(found) << name;
    return found ? (*found)->retro : Retroreflection{};
  };
  // 1.8, 1.125 and 0.45 cd/lx over 72 cm².
  EXPECT_NEAR(sheeting_r_a(retro("post reflector white"), 0.33, 5) * 0.0072, 1.8, 1e-4);
  EXPECT_NEAR(sheeting_r_a(retro("post reflector amber"), 0.33, 5) * 0.0072, 1.125, 1e-4);
  EXPECT_NEAR(sheeting_r_a(retro("post reflector red"), 0.33, 5) * 0.0072, 0.45, 1e-4);
  EXPECT_NEAR(sheeting_r_a(retro("sign sheeting RA3 yellow"), 0.33, 20), 0.65 * 240, 1e-2);
  EXPECT_EQ(retro("road marking type II").r_l_mcd_per_lx_m2, 200.0);
  EXPECT_EQ(retro("road marking type II").wet_mcd_per_lx_m2, 50.0);
  EXPECT_EQ(retro("road marking type II worn").wet_mcd_per_lx_m2, 25.0);
}

TEST(MaterialLibrary, WrongEntriesSayWhere) {
  const auto reason = [](const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / "phare_surfaces.toml";
    std::ofstream(file) << text;
    const Result<MaterialLibrary> library = MaterialLibrary::read(file);
    return library ? std::string("was read") : library.error().text();
  };
  const std::string good = "[[material]]\nname = \"a\"\nreflectance = [0.1, 0.1, 0.1]\nsource = \"made up here\"\n";
  EXPECT_EQ(reason(good), "was read");
  const std::string unknown = reason(good + "surface = \"gras\"\n");
  EXPECT_NE(unknown.find("surfaces.toml:5: "), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("unknown surface 'gras'"), std::string::npos) << unknown;
  EXPECT_NE(reason(good + "retro = \"EN 1436 R9\"\n").find("surfaces.toml:5:"), std::string::npos);
  EXPECT_EQ(reason(good + "roughness_deg = 30.0\n"), "was read");
  EXPECT_NE(reason(good + "roughness_deg = 70.0\n").find("surfaces.toml:5:"), std::string::npos);
  EXPECT_NE(reason(good + "retro = \"EN 1436 R4\"\nroughness_deg = 30.0\n").find("surfaces.toml:6:"),
            std::string::npos);
  EXPECT_NE(reason(good + "retro = \"UN R3 IVA white\"\n").find("is needed"), std::string::npos);
  EXPECT_NE(reason(good + "retroreflection_cd_per_lx_m2 = 3.0\n").find("retroreflection_cd_per_lx_m2"),
            std::string::npos);
  EXPECT_NE(reason(good + "words = [\"Two words\"]\n").find("one word"), std::string::npos);
  EXPECT_NE(reason(good + good).find("twice"), std::string::npos);
  EXPECT_NE(reason("[[material]]\nname = \"a\"\nreflectance = [0.1, 2, 0.1]\nsource = \"made\"\n").find(":3:"),
            std::string::npos);
}

}  // namespace
}  // namespace phare
