// Every reader against damaged input: no crash, no hang, memory bounded by the file. A short deterministic run here;
// PHARE_FUZZ_ROUNDS makes it as long as wanted, and photometry_fuzz.cpp is the libFuzzer target of the same readers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "photometry_test_files.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

struct Seed {
  LampFormat format;
  std::string text;
};

/// A small table in every format, and the odd and broken files of the reference set where they are.
std::vector<Seed> seeds() {
  IntensityTable a;
  a.name = "seed";
  a.first_deg = {-20, -5, 0, 5, 20};
  a.second_deg = {-5, -1, 0.5, 5};
  for (int i = 0; i < 20; ++i) a.candela.push_back(100.5 * i);
  const IntensityTable c = resample(a, PhotometricType::kC, GammaAxis::kGamma0, {0, 90, 180, 270, 360}, {0, 5, 20, 90});
  std::vector<Seed> all{{LampFormat::kLm63, lm63_text(a)},
                        {LampFormat::kLm63, lm63_text(c)},
                        {LampFormat::kEulumdat, eulumdat_text(c)},
                        {LampFormat::kCsv, csv_text(a)},
                        {LampFormat::kCsv, csv_text(c)}};
  all.push_back({LampFormat::kCsv, "# unit: lx\n# distance_m: 25\nz\\y,-2,0,2\n1,1,2,3\n-1,4,5,6\n"});
  all.push_back({LampFormat::kCsv, "h_deg,v_deg,intensity_cd\n0,0,1\n0,1,2\n5,0,3\n5,1,4\n"});
  std::string xml =
      "<?xml "
      "version=\"1.0\"?><IESTM33-22><Version>1.1</Version><Emitter><LuminousData><PhotometryType>C</PhotometryType>";
  for (const char* h : {"0", "90"}) {
    for (const char* v : {"0", "45", "90"})
      xml += std::string("<IntensityData horz=\"") + h + "\" vert=\"" + v + "\">12.5</IntensityData>\n";
  }
  all.push_back({LampFormat::kTm33, xml + "</LuminousData></Emitter></IESTM33-22>"});
  std::error_code code;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::shared_data("photometry-reference/formats"), code)) {
    if (entry.path().extension() == ".ies") all.push_back({LampFormat::kLm63, test::content_of(entry.path())});
  }
  return all;
}

/// Cuts, doubles, swaps and overwrites; now and then a number that means trouble.
std::string damage(std::string text, std::mt19937& random, const std::vector<Seed>& all) {
  static const char* const kWords[] = {"-1", "0",  "1e308", "nan", "inf", "99999999999",    "1e-320",      "",
                                       "\n", "\"", "<",     ",",   "\\",  "TILT=INCLUDE\n", "\xEF\xBB\xBF"};
  const int changes = 1 + static_cast<int>(random() % 3 == 0 ? random() % 4 : 0);
  for (int k = 0; k < changes; ++k) {
    if (text.empty()) return text;
    const std::size_t at = random() % text.size();
    switch (random() % 7) {
      case 0:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        text.erase(at, 1 + random() % 20);
        break;
      case 2:
        text.insert(at, kWords[random() % std::size(kWords)]);
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, text.substr(at, random() % 60));
        break;
      case 5: {
        const std::string& other = all[random() % all.size()].text;
        if (!other.empty()) text.replace(at, random() % 40, other.substr(random() % other.size(), random() % 80));
        break;
      }
      default: {  // a number in place of a number
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text.replace(digit, 1 + random() % 3, kWords[random() % 7]);
      }
    }
  }
  return text;
}

TEST(Fuzz, EveryReaderSurvivesDamage) {
  const char* const wanted = std::getenv("PHARE_FUZZ_ROUNDS");
  const int rounds = wanted != nullptr ? std::max(1, std::atoi(wanted)) : 12000;
  const std::vector<Seed> all = seeds();
  std::mt19937 random(20240607);
  std::size_t read_count = 0;
  for (int round = 0; round < rounds; ++round) {
    const Seed& seed = all[static_cast<std::size_t>(round) % all.size()];
    const std::string text = damage(seed.text, random, all);
    LampReadSettings settings;
    settings.format = round % 5 == 0 ? LampFormat::kFind : seed.format;
    settings.c0_turn_deg = round % 3 == 0 ? 33.0 : 0.0;
    settings.mirror_h = round % 4 == 0;
    const auto table = parse_lamp(text, "damaged", settings);
    if (!table) {
      ASSERT_FALSE(table.error().reason.empty());
      ASSERT_LT(table.error().text().size(), 400u);
      continue;
    }
    ++read_count;
    // What is read is whole and of a size the file can account for.
    ASSERT_EQ(table->candela.size(), table->first_deg.size() * table->second_deg.size());
    ASSERT_GE(table->first_deg.size(), 2u);
    ASSERT_GE(table->second_deg.size(), 2u);
    ASSERT_TRUE(std::is_sorted(table->first_deg.begin(), table->first_deg.end()));
    ASSERT_TRUE(std::is_sorted(table->second_deg.begin(), table->second_deg.end()));
    ASSERT_LE(table->candela.size(), 4 * text.size() + 16);
    for (const double cd : table->candela) ASSERT_TRUE(std::isfinite(cd) && cd >= 0.0);
    ASSERT_GE(table->intensity_cd({1.0, 0.1, 0.05}), 0.0);
    if (round % 50 == 0) (void)lint_lamp(*table);
  }
  std::printf("%d damaged files: %zu read, the rest refused\n", rounds, read_count);
  EXPECT_GT(read_count, 0u);
}

// Hostile sizes: counts that promise more than the file holds allocate nothing of that size.
TEST(Fuzz, PromisesAreNotBelieved) {
  const std::string zeros(3000, '0');
  for (const char* const text : {"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 900 900 3 2 0 0 0\n1 1 0\n",
                                 "TILT=INCLUDE\n1\n500\n0", "TILT=NONE\n1 1 1 1e9 1e9 1 1 1 1 1"})
    EXPECT_FALSE(parse_lamp(text, "a.ies").ok());
  EXPECT_FALSE(parse_lamp("a\n1\n0\n1000000\n1\n1000000\n" + zeros, "a.ldt").ok());
  std::string nested = "<IESTM33-22>";
  for (int i = 0; i < 20000; ++i) nested += "<a>";
  EXPECT_FALSE(parse_lamp(nested, "a.xml").ok());
  const std::string bomb =
      "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">]><IESTM33-22>&b;&b;</IESTM33-22>";
  EXPECT_FALSE(parse_lamp(bomb, "a.xml").ok());
  EXPECT_FALSE(parse_lamp("# unit: cd\nV\\H," + std::string(5000, ',') + "\n", "a.csv").ok());
}

}  // namespace
}  // namespace phare
