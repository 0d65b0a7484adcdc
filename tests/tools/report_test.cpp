// unit: the report merges the processes' files and stays whole when some are missing or broken; the page escapes.
#include "tools/report.h"

#include <gtest/gtest.h>

#include <fstream>

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
         R"("interval_ms":{"count":9,"min":1.0,"median":10.0,"p95":3.0,"p99":4.0,"max":5.0},"pass_ms":{"lamps":{"median":1.0}},"device":"<lavapipe>"})";
  std::ofstream(out / "birds_eye.png") << "x";

  Rig rig;
  rig.name = "<test> & road";
  DriveFacts facts;
  facts.process_names = {"cockpit", "dynamics", "visual-0"};
  facts.restarts = {{"dynamics", 1.5, "SIGKILL"}};
  facts.ends = {{"cockpit", "exit 0"}, {"dynamics", "SIGKILL"}, {"visual-0", "exit 0"}};
  facts.command = {"phare", "drive"};
  const nlohmann::json report = make_report(rig, facts, out);
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
  EXPECT_NE(page.find("<b>62.5</b><i>frames a second: all frames by all seconds; 100 by the median interval</i>"),
            std::string::npos);
  EXPECT_EQ(page.find("wall_25m.png"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);  // self-contained
}

TEST(Report, NoProcessLeftAFile) {
  const nlohmann::json report = make_report(Rig{}, DriveFacts{}, "/nowhere");
  EXPECT_TRUE(report["processes"].empty());
  EXPECT_FALSE(report_page(report, "/nowhere").empty());
}

}  // namespace
}  // namespace phare
