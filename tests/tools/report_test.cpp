// unit: the report merges the processes' files and stays whole when some are missing or broken; the page escapes.
#include "tools/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "config/base/content_hash.h"
#include "visual/photometry/beam/lamp_tables.h"

namespace phare {
namespace {

TEST(Report, MergesWhatThereIs) {
  const auto out = std::filesystem::path(testing::TempDir()) / "phare_report_test";
  std::filesystem::remove_all(out);
  std::filesystem::create_directories(out);
  std::ofstream(out / "cockpit.json")
      << R"({"process":"cockpit","bus":{"vehicle_state":{"received":7,"lost":1,"late":0,"duplicate":2,"restarted":0},)"
         R"("frame_report":{"received":3,"lost":0,"late":0,"duplicate":0,"restarted":1},"sent":{"cockpit_state":9},"refused":4},)"
         R"("memory":{"rss_kib":10,"peak_kib":20}})";
  std::ofstream(out / "dynamics.json") << "{ broken";
  std::ofstream(out / "visual-0.json")
      << R"({"process":"visual","frames":10,"frames_per_s":62.5,"drawn_s":0.144,"frame_ms":{"count":10,"min":1.0,"median":2.0,"p95":3.0,"p99":4.0,"max":5.0},)"
         R"("interval_ms":{"count":9,"min":1.0,"median":10.0,"p95":3.0,"p99":4.0,"max":5.0},"pass_ms":{"lamps":{"median":1.0}},"device":"<lavapipe>",)"
         R"("effects":[{"name":"shadows","level":"soft","because":"a post","needs":"maps","passes":2,"bytes":4300000,"ms":0.25},)"
         R"({"name":"eyeshine","level":"on","because":"a deer","needs":"a draw","passes":0,"bytes":0}],)"
         R"("frames_stale_pose":2,"fail_safe":{"frames":3,"count":1,"times":[{"from_s":1.5,"to_s":1.75,"because":"no cockpit for 0.3 s: low beam"}]}})";
  std::ofstream(out / "birds_eye.png") << "x";

  Rig rig;
  rig.name = "<test> & road";
  DriveFacts facts;
  facts.process_names = {"cockpit", "dynamics", "visual-0"};
  facts.restarts = {{"dynamics", 1.5, "SIGKILL"}};
  facts.ends = {{"cockpit", "exit 0"}, {"dynamics", "SIGKILL"}, {"visual-0", "exit 0"}};
  facts.command = {"phare", "drive", "--set", "probes=car 25 0 0"};
  std::ofstream(out / "others.toml") << "x";
  facts.traffic_file = out / "others.toml";
  const nlohmann::json report = make_report(rig, facts, out);
  EXPECT_EQ(report["traffic"]["file"], "others.toml");
  EXPECT_EQ(report["traffic"]["content_hash"].get<std::string>(), *content_hash_of_file(out / "others.toml"));
  EXPECT_EQ(report["summary"]["messages"]["cockpit"]["received"], 10);
  EXPECT_EQ(report["summary"]["messages"]["cockpit"]["lost"], 1);
  EXPECT_EQ(report["summary"]["messages"]["cockpit"]["duplicate"], 2);
  EXPECT_EQ(report["summary"]["messages"]["cockpit"]["refused"], 4);
  EXPECT_FALSE(report["processes"].contains("dynamics"));
  EXPECT_EQ(report["summary"]["frames"], 10);
  EXPECT_DOUBLE_EQ(report["summary"]["frames_per_s_median"].get<double>(), 100.0);
  EXPECT_DOUBLE_EQ(report["summary"]["frames_per_s"].get<double>(), 62.5);
  EXPECT_EQ(report["restarts"][0]["because"], "SIGKILL");

  const std::string page = report_page(report, out);
  EXPECT_NE(page.find("&lt;test&gt; &amp; road"), std::string::npos);
  EXPECT_NE(page.find("&lt;lavapipe&gt;"), std::string::npos);
  EXPECT_NE(page.find("birds_eye.png"), std::string::npos);
  EXPECT_NE(page.find("phare drive --set 'probes=car 25 0 0' "), std::string::npos);
  EXPECT_NE(page.find("<td>traffic</td><td class=\"text\">others.toml"), std::string::npos);
  EXPECT_NE(
      page.find("62.5 frames a second: all frames after the first by all seconds since; 100 by the median interval"),
      std::string::npos);
  EXPECT_NE(page.find("3 pictures with the low beam of the fail-safe, 1 times"), std::string::npos);
  EXPECT_NE(page.find("1.500 to 1.750 s: no cockpit for 0.3 s: low beam"), std::string::npos);
  EXPECT_NE(page.find("2 pictures with a pose that was held"), std::string::npos);
  EXPECT_NE(page.find("<td class=\"text\">maps</td><td>2</td><td>4.3</td><td>0.25</td>"), std::string::npos);
  EXPECT_NE(page.find("<td class=\"text\">a draw</td><td>0</td><td>0.0</td><td>–</td>"), std::string::npos);
  EXPECT_EQ(page.find("wall_25m.png"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);  // self-contained
}

// Why level auto switched stands in the report, and on its page.
TEST(Report, SaysWhyLevelAutoSwitched) {
  const auto out = std::filesystem::path(testing::TempDir()) / "phare_report_auto_test";
  std::filesystem::remove_all(out);
  std::filesystem::create_directories(out);
  std::ofstream(out / "dynamics.json")
      << R"({"process":"dynamics","auto":{"level":"full","switches":1,"seconds":{"kinematic":12.34,"full":3.0},"history":[)"
         R"({"time_s":12.34,"from":"kinematic","to":"full","because":"low friction","fact":0.3}]}})";
  DriveFacts facts;
  facts.process_names = {"dynamics"};
  const nlohmann::json report = make_report(Rig{}, facts, out);
  EXPECT_EQ(report["processes"]["dynamics"]["auto"]["history"][0]["to"], "full");
  const std::string page = report_page(report, out);
  EXPECT_NE(page.find("kinematic 12.3 s, 1 switches."), std::string::npos);
  EXPECT_NE(page.find("<td>12.340</td><td class=\"text\">kinematic</td><td class=\"text\">full</td><td "
                      "class=\"text\">low friction</td><td>0.3</td>"),
            std::string::npos);
}

// A TM-33 file of two emitters, an EULUMDAT file with two lamp sets, a mirrored and a scaled lamp: the report, the
// picture's process and `measure` read them alike, with all that the rig says of them.
TEST(Report, FluxAndPeakAreOfTheSourceAsTheRigReadsIt) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("phare_report_lamps_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto emitter = [](int cd) {
    std::string text = "<Emitter><LuminousData><PhotometryType>CIE-A</PhotometryType><SymmType>Symm _ None</SymmType>";
    for (const int h : {-10, 10})
      for (const int v : {-5, 5})
        text += "<IntensityData horz=\"" + std::to_string(h) + "\" vert=\"" + std::to_string(v) + "\">" +
                std::to_string(h > 0 ? cd : cd / 2) + "</IntensityData>";
    return text + "</LuminousData></Emitter>";
  };
  std::ofstream(folder / "two.xml") << "<?xml version=\"1.0\"?>\n<t:IESTM33-22 xmlns:t=\"http://www.ies.org/tm-33\">"
                                    << "<Version>1.1</Version>" << emitter(1000) << emitter(400) << "</t:IESTM33-22>\n";
  std::ofstream ldt(folder / "sets.ldt");
  ldt << "Maker\n1\n1\n1\n0\n2\n0\nreport\nname\nnumber\nfile\n2024\n";
  for (int i = 13; i <= 21; ++i) ldt << "0\n";
  ldt << "100\n80\n1\n0\n2\n1\nLED\n1000\nwhite\n80\n10\n1\nLED\n2500\nwhite\n80\n10\n";
  for (int i = 0; i < 10; ++i) ldt << "0.5\n";
  ldt << "0\n0\n90\n100\n40\n";  // C 0; gamma 0 and 90; cd per klm
  ldt.close();

  SourceConfig first{.function = LampFunction::kLow, .file = folder / "two.xml"},
      second = first, halved = first, turned = first,
      small{.function = LampFunction::kHigh, .file = folder / "sets.ldt"}, large = small;
  second.emitter = 2;
  halved.scale = 0.5;
  turned.mirror = true;
  large.lamp_set = 2;
  Rig rig;
  rig.designs = {{.name = "d", .lamps = {{.name = "lamp", .sources = {first, second, halved, turned, small, large}}}}};
  const nlohmann::json lamps = make_report(rig, DriveFacts{}, "/nowhere")["lamps"];
  ASSERT_EQ(lamps.size(), 6u);
  EXPECT_DOUBLE_EQ(lamps[0]["peak_cd"].get<double>(), 1000.0);
  EXPECT_DOUBLE_EQ(lamps[1]["peak_cd"].get<double>(), 400.0);
  EXPECT_DOUBLE_EQ(lamps[1]["flux_lm"].get<double>(), 0.4 * lamps[0]["flux_lm"].get<double>());
  EXPECT_EQ(lamps[1]["emitter"], 2);
  EXPECT_FALSE(lamps[0].contains("emitter"));
  EXPECT_DOUBLE_EQ(lamps[2]["peak_cd"].get<double>(), 500.0);
  EXPECT_DOUBLE_EQ(lamps[2]["flux_lm"].get<double>(), 0.5 * lamps[0]["flux_lm"].get<double>());
  EXPECT_DOUBLE_EQ(lamps[3]["peak_cd"].get<double>(), 1000.0);
  EXPECT_EQ(lamps[3]["mirror"], true);
  EXPECT_DOUBLE_EQ(lamps[4]["peak_cd"].get<double>(), 100.0);
  EXPECT_DOUBLE_EQ(lamps[5]["peak_cd"].get<double>(), 250.0);
  // The same numbers as whoever lights the road with them.
  LampTables tables;
  for (std::size_t i = 0; i < 6; ++i) {
    const SourceConfig& source = rig.designs[0].lamps[0].sources[i];
    ASSERT_TRUE(tables.add(source).ok());
    EXPECT_DOUBLE_EQ(lamps[i]["flux_lm"].get<double>(), source.scale * tables.of(source).flux_lm()) << i;
  }
  std::set<std::string> readings;
  for (const auto& [key, table] : tables) readings.insert(LampTables::reading(key));
  EXPECT_EQ(readings, (std::set<std::string>{"", "emitter 2", "lamp set 2", "mirrored"}));
  std::filesystem::remove_all(folder);
}

TEST(Report, OneFrameHasNoRate) {
  const auto out = std::filesystem::path(testing::TempDir()) / ("phare_report_one_" + std::to_string(::getpid()));
  std::filesystem::create_directories(out);
  std::ofstream(out / "visual-0.json") << R"({"process":"visual","frames":1,"frames_per_s":0.0,"drawn_s":0.0})";
  DriveFacts facts;
  facts.process_names = {"visual-0"};
  const nlohmann::json report = make_report(Rig{}, facts, out);
  EXPECT_EQ(report["summary"]["frames"], 1);
  EXPECT_FALSE(report["summary"].contains("frames_per_s"));
  EXPECT_EQ(report_page(report, out).find("frames a second"), std::string::npos);
  std::filesystem::remove_all(out);
}

TEST(Report, SaysHowLateAControlLawAnswered) {
  const auto out = std::filesystem::path(testing::TempDir()) / ("phare_report_law_" + std::to_string(::getpid()));
  std::filesystem::create_directories(out);
  std::ofstream(out / "visual-0.json")
      << R"({"process":"visual","frames":9,"law":{"answers":7,"in_frame":6,"delay_ms":{"median":1.5,"p99":20.25,"max":21.0},)"
         R"("silent_frames":2,"refused":1,"why":"lamp \"left\": has 3 sources, not 2"}})";
  DriveFacts facts;
  facts.process_names = {"visual-0"};
  const nlohmann::json report = make_report(Rig{}, facts, out);
  EXPECT_EQ(report["summary"]["law"]["answers"], 7);
  const std::string page = report_page(report, out);
  EXPECT_NE(
      page.find("7 answers; from the pose to the answer to it 1.50 ms median, 20.25 ms 99th percentile, 21.00 ms at "
                "most; 6 within a frame's time. Frames without an answer, on low beam: 2; answers that were not "
                "followed: 1."),
      std::string::npos);
  EXPECT_NE(page.find("has 3 sources, not 2"), std::string::npos);
  std::filesystem::remove_all(out);
}

TEST(Report, NoProcessLeftAFile) {
  const nlohmann::json report = make_report(Rig{}, DriveFacts{}, "/nowhere");
  EXPECT_TRUE(report["processes"].empty());
  EXPECT_FALSE(report_page(report, "/nowhere").empty());
}

}  // namespace
}  // namespace phare
