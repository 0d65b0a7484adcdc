#include "tests/can/can_rig.h"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "tests/paths.h"

namespace phare::can_test {

Rig::Rig(const std::string& interface, double timeout_s, const std::string& more) {
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_st>(log_)));
  const auto config = parse_cockpit("[source]\nkind = \"can\"\ninterface = \"" + interface +
                                        "\"\ntimeout_s = " + std::to_string(timeout_s) +
                                        "\n[control.light_switch]\nmessage = \"BEAM_STALK\"\nsignal = \"BEAM_SWITCH\"\n"
                                        "levels = { off = 0, position = 1, low = 2, high = 3 }\n" +
                                        more,
                                    "rig.toml");
  EXPECT_TRUE(config.ok()) << (config.ok() ? "" : config.error().text());
  const Dbc dbc = *read_dbc(std::filesystem::path(cockpits_dir()) / "phare_stalk.dbc");
  auto map = SignalMap::bind(*config, dbc, wall_now().ns);
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().text());
  auto feedback = Feedback::bind(*config, dbc);
  EXPECT_TRUE(feedback.ok());
  auto source = CanSource::open(interface, std::move(*map), std::move(*feedback));
  EXPECT_TRUE(source.ok()) << (source.ok() ? "" : source.error().text());
  source_ = std::move(*source);
  cockpit_ = std::make_unique<Cockpit>(switch_params(*config, 1), interface);
}

bool Rig::until(const std::function<bool()>& done) {
  const auto limit = Clock::now() + kPatience;
  while (true) {
    const Moment now{SimTime{std::chrono::nanoseconds(Clock::now() - start_).count()}, wall_now()};
    source_->advance(now, nullptr, *cockpit_);
    FeedbackValues values;
    values.telltales = cockpit_->telltales(now.sim);
    values.speed_mps = 10.0;
    source_->send_back(values, now.wall);
    if (done()) return true;
    if (Clock::now() > limit) return false;
    std::this_thread::sleep_for(1ms);
  }
}

int Rig::said(const std::string& text) const {
  const std::string all = log_.str();
  int count = 0;
  for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) ++count;
  return count;
}

}  // namespace phare::can_test
