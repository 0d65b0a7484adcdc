// unit: the page of a drive: its series, its plots, the figures it opens with, one file to be mailed; what the lamps
// are worth by themselves.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "config/base/base64.h"
#include "config/rig.h"
#include "tests/paths.h"
#include "tools/drive_series.h"
#include "tools/drive_video.h"
#include "tools/lamp_verdicts.h"
#include "tools/report.h"
#include "tools/time_plot.h"

namespace phare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Base64, AsInRfc4648) {
  const std::vector<std::pair<std::string, std::string>> vectors{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string("\xff\xfe\0", 3)), "//4A");
}

// No pipe is left for ffmpeg: a descriptor is one too few.
TEST(DriveVideo, SaysWhyItDoesNotStart) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs descriptors of its own";
#endif
  const fs::path out = fs::path(testing::TempDir()) / ("phare_drive_video_" + std::to_string(::getpid()));
  fs::create_directories(out / "frames");
  std::ofstream(out / "ffmpeg") << "#!/bin/sh\n";
  fs::permissions(out / "ffmpeg", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", out.c_str(), 1);
  DriveSeries series;
  for (std::int64_t frame : {0, 1}) {
    series.pictures.push_back({frame, 0.1 * static_cast<double>(frame)});
    std::ofstream(out / ("frames/00000" + std::to_string(frame) + ".png")) << "x";
  }
  testing::internal::CaptureStdout();
  rlimit all{};
  getrlimit(RLIMIT_NOFILE, &all);
  const int free = ::dup(0);
  ::close(free);
  const rlimit one{static_cast<rlim_t>(free) + 1, all.rlim_max};
  setrlimit(RLIMIT_NOFILE, &one);
  EXPECT_FALSE(make_video(out, series, 10, true, [] { return false; }));
  setrlimit(RLIMIT_NOFILE, &all);
  setenv("PATH", path.c_str(), 1);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("pipe: Too many open files, so no drive.mp4"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(out / "drive.mp4.txt"));
  fs::remove_all(out);
}

class DrivePage : public testing::Test {
 protected:
  DrivePage() : out_(fs::path(testing::TempDir()) / ("phare_drive_page_" + std::to_string(::getpid()))) {
    fs::remove_all(out_);
    fs::create_directories(out_);
    // 4 s at 10 m/s, dark for the first second; reach in every other row; the last row is cut off.
    std::ofstream csv(out_ / "drive.csv");
    csv << "frame,time_s,x_m,y_m,pitch_rad,speed_mps,lit,design,picture,cutoff_25m_m,reach_3lx_left_m,reach_3lx_right_"
           "m\n";
    for (int i = 0; i <= 40; ++i) {
      const double t = 0.1 * i;
      const bool lit = i >= 10;
      csv << i << "," << t << "," << 10.0 * t << ",0," << 0.001 * i << ",10," << (lit ? "\"low\"" : "\"\"")
          << ",\"one, \"\"two\"\"\"," << (i % 10 == 0) << "," << (lit ? std::to_string(0.4 + 0.001 * i) : "") << ","
          << (i % 2 == 0 ? (lit ? std::to_string(30 + i) : "0") + ",70" : ",") << "\n";
    }
    csv << "41,4.1,41";
    csv.close();
    for (const char* file : {"drivers_view.png", "birds_eye.png", "wall_25m.png", "birds_eye_2.png", "wall_25m_2.png",
                             "contact_sheet.png", "drive.mp4"})
      std::ofstream(out_ / file) << "content of " << file;
    std::ofstream(out_ / "visual-0.json")
        << R"({"process":"visual","frames":41,"designs":[{"index":0,"name":"one, \"two\"","lit_s":3.0,"in_the_stills":true},)"
           R"({"index":2,"name":"three","lit_s":0.5,"in_the_stills":false}]})";
  }
  ~DrivePage() override { fs::remove_all(out_); }

  json report() const {
    DriveFacts facts;
    facts.process_names = {"visual-0"};
    json report = make_report(Rig{}, facts, out_);
    report["drove"] = figures_of(**read_drive_series(out_));
    return report;
  }
  std::vector<std::string> references(const std::string& page) const {
    std::vector<std::string> all;
    const std::regex reference("(?:src|href)=\"([^\"]*)\"");
    for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end; ++it) all.push_back((*it)[1]);
    return all;
  }

  const fs::path out_;
};

TEST_F(DrivePage, ReadsItsSeries) {
  const auto read = read_drive_series(out_);
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_TRUE(read->has_value());
  const DriveSeries& series = **read;
  EXPECT_EQ(series.rows, 41u);
  EXPECT_NEAR(series.distance_m, 40.0, 1e-6);
  ASSERT_EQ(series.lit.size(), 2u);
  EXPECT_EQ(series.lit[1].design, "one, \"two\"");
  EXPECT_DOUBLE_EQ(series.lit[1].from_s, 1.0);
  EXPECT_EQ(series.pictures.size(), 5u);
  ASSERT_EQ(series.reach_m.size(), 2u);
  EXPECT_EQ(series.reach_m[0].value.size(), 21u);
  const json figures = figures_of(series);
  EXPECT_NEAR(figures["driven_s"].get<double>(), 4.0, 1e-9);
  EXPECT_NEAR(figures["speed_kmh"]["median"].get<double>(), 36.0, 1e-9);
  EXPECT_NEAR(figures["cutoff_25m_m"]["max"].get<double>(), 0.44, 1e-9);
  EXPECT_EQ(figures["reach_m"]["reach_3lx_left_m"]["min"], 40.0);  // the dark second does not count
  EXPECT_EQ(figures["reach_m"]["reach_3lx_left_m"]["median"], 54.0);

  EXPECT_FALSE(read_drive_series("/nowhere")->has_value());
  std::ofstream(out_ / "drive.csv", std::ios::app) << ",0\n1,2\n";
  const auto broken = read_drive_series(out_);
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(broken.error().text().find("drive.csv:43: expected 12 cells, got 4"), std::string::npos)
      << broken.error().text();
}

// Where somebody sought, the car was set elsewhere: that is no way.
TEST_F(DrivePage, ASeekBackIsNoWay) {
  std::ofstream csv(out_ / "drive.csv");
  csv << "frame,time_s,x_m,y_m,pitch_rad,speed_mps,lit,design,picture,cutoff_25m_m\n";
  for (const double t : {3.0, 3.1, 3.2, 1.0, 1.1})
    csv << "0," << t << "," << 10.0 * t << ",0,0,10,\"low\",\"one\",0,0.4\n";
  csv.close();
  const json figures = figures_of(**read_drive_series(out_));
  EXPECT_NEAR(figures["distance_m"].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(figures["driven_s"].get<double>(), 0.3, 1e-9);
}

TEST_F(DrivePage, OpensWithWhatWasDrivenAndHasEveryPicture) {
  const json told = report();
  const std::string page = report_page(told, out_);
  // The figures of the report.
  EXPECT_NE(page.find("<b>4.0 s</b><i>driven, 40 m along the road</i>"), std::string::npos);
  EXPECT_NE(page.find("<b>36 km/h</b>"), std::string::npos);
  EXPECT_NE(page.find("<b>54 m</b><i>3 lx on the left edge of the lane reach so far (median), 40 to 70</i>"),
            std::string::npos);
  EXPECT_NE(page.find("<b>0.42 m</b><i>cut-off on a wall at 25 m (median), 0.41 to 0.44</i>"), std::string::npos);
  // What is referred to is there, and each design has both its pictures.
  const std::vector<std::string> all = references(page);
  for (const std::string& file : all)
    EXPECT_TRUE(file == "report.json" || fs::exists(out_ / file)) << file;
  for (const char* file : {"drivers_view.png", "drive.mp4", "birds_eye.png", "wall_25m.png", "birds_eye_2.png",
                           "wall_25m_2.png", "contact_sheet.png", "drive.csv"})
    EXPECT_NE(std::ranges::find(all, file), all.end()) << file;
  // The order: how good it was, then the folded rest.
  const std::size_t facts = page.find("class=\"facts\""), video = page.find("<video"), plot = page.find("<svg"),
                    wall = page.find("wall_25m.png"), folded = page.find("<details>");
  EXPECT_TRUE(facts < video && video < plot && plot < wall && wall < folded && folded < page.size());
  EXPECT_EQ(page.find("<details open"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST_F(DrivePage, IsOneFileToBeMailed) {
  const std::string page = report_page(report(), out_, PageFiles::kWithin);
  for (const std::string& file : references(page)) EXPECT_TRUE(file.starts_with("data:")) << file.substr(0, 80);
  EXPECT_NE(page.find("data:image/png;base64," + base64("content of wall_25m_2.png")), std::string::npos);
  EXPECT_NE(page.find("data:video/mp4;base64," + base64("content of drive.mp4")), std::string::npos);
}

// Glare has its plots where somebody came toward the car, and nowhere else: neither where drive.csv has no such columns
// nor where all of them are 0.
TEST_F(DrivePage, ShowsGlareWhereSomebodyCame) {
  const char* const titles[] = {"Veil over the eyes by lamps that shine into them, cd/m²",
                                "Threshold increment by these lamps, %", "Discomfort by these lamps on de Boer"};
  const auto with_glare = [&](bool came) {
    std::ofstream csv(out_ / "drive.csv");
    csv << "frame,time_s,x_m,y_m,pitch_rad,speed_mps,lit,design,picture,veil_cdm2,threshold_increment_percent,de_boer,"
           "others_veil_cdm2,others_threshold_increment_percent,others_de_boer\n";
    for (int i = 0; i <= 40; ++i)
      csv << i << "," << 0.1 * i << "," << i << ",0,0,10,low,one,0,0,0,,"
          << (came && i > 20 && i < 30 ? "0.5,32,4.5" : "0,0,") << "\n";
    csv.close();
    return report_page(report(), out_);
  };
  const std::string without = report_page(report(), out_), alone = with_glare(false), met = with_glare(true);
  for (const char* title : titles) {
    EXPECT_EQ(without.find(title), std::string::npos) << title;
    EXPECT_EQ(alone.find(title), std::string::npos) << title;
    EXPECT_NE(met.find(title), std::string::npos) << title;
  }
  const auto read = read_drive_series(out_);
  ASSERT_TRUE(read.ok()) << read.error().text();
  const DriveSeries& series = **read;
  ASSERT_EQ(series.veil_cdm2.size(), 1u) << "nothing shone into the driver's eyes";
  EXPECT_EQ(series.veil_cdm2[0].name, "who comes toward the car");
  EXPECT_EQ(std::ranges::max(series.veil_cdm2[0].value), 0.5);
  EXPECT_EQ(series.de_boer.at(0).value.at(25), 4.5);
  EXPECT_TRUE(std::isnan(series.de_boer.at(0).value.at(5)));
}

// Of 6000 values in 1000 columns the one that stands out is drawn.
TEST(TimePlot, LosesNoPeak) {
  TimeSeries line{.name = "line"};
  for (int i = 0; i < 6000; ++i) {
    line.time_s.push_back(0.01 * i);
    line.value.push_back(i == 3217 ? 9.5 : i >= 4000 && i < 5000 ? std::nan("") : 1.0);
  }
  const std::string svg =
      time_plot_svg({.title = "a < b", .unit = "m", .lines = {line}, .from_s = 0.0, .to_s = 60.0, .from_zero = true});
  EXPECT_NE(svg.find("a &lt; b, m"), std::string::npos);
  const std::size_t at = svg.find("class=\"line\"");
  ASSERT_NE(at, std::string::npos);
  const std::string path = svg.substr(at, svg.find("/>", at) - at);
  EXPECT_EQ(std::ranges::count(path, 'M'), 2);  // broken where there is no value
  EXPECT_EQ(path.find("nan"), std::string::npos);
  // Axis 0 to 10, from y 196 to y 34: 9.5 lies at 42.1.
  EXPECT_NE(path.find(" 42.1"), std::string::npos);
  EXPECT_LT(path.size(), 40000u);
  EXPECT_DOUBLE_EQ(nice_step(7.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(nice_step(0.1, 5), 0.02);
  EXPECT_DOUBLE_EQ(nice_step(26.0, 5), 10.0);
}

TEST(LampVerdicts, AreThoseOfCheckAndHspr) {
  const auto rig = read_rig(source_dir() + "/config/rigs/country_road.toml");
  ASSERT_TRUE(rig.ok()) << rig.error().text();
  const json rows = lamp_verdicts(*rig, rules_dir());
  std::set<std::string> designs;
  for (const json& row : rows) {
    designs.insert(row["design"].get<std::string>());
    ASSERT_FALSE(row.contains("none")) << row.dump();
    // Our own lamps are made to pass (visual/photometry/bench/sample_lamps.h).
    bool passed = false;
    for (const json& rule : row["rules"]) passed |= rule["verdict"] == "pass" || rule["verdict"] == "within resolution";
    EXPECT_TRUE(passed) << row.dump();
    EXPECT_TRUE(row["beam"] != "low" || row.contains("hspr")) << row.dump();
    if (!row.contains("hspr")) continue;
    EXPECT_NEAR(row["hspr"]["height_m"].get<double>(), 0.66, 0.1) << "the rig's, not the method's 0.75: " << row.dump();
    EXPECT_NEAR(row["hspr"]["spacing_m"].get<double>(), 1.24, 1e-9) << row.dump();
  }
  EXPECT_EQ(designs.size(), rig->designs.size());

  // Half the light fails the rule, and says by what.
  Rig weak = *rig;
  weak.designs.resize(1);
  for (LampConfig& lamp : weak.designs[0].lamps)
    for (SourceConfig& source : lamp.sources) source.scale *= 0.3;
  EXPECT_NE(lamp_verdicts(weak, rules_dir())[0]["files"].get<std::string>().find("× 0.3"), std::string::npos);
  const json low = lamp_verdicts(weak, rules_dir())[0];
  EXPECT_EQ(low["rules"][0]["verdict"], "fail");
  EXPECT_LT(low["rules"][0]["worst"]["value"], low["rules"][0]["worst"]["limit"]);
}

}  // namespace
}  // namespace phare
