// phare-visual: one channel of the picture. Reads the rig, its scene and its lamps, then draws what the bus says.
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "config/base/fail.h"
#include "config/base/remedies.h"
#include "config/base/standard_output.h"
#include "net/drive_file.h"
#include "net/run_key.h"
#include "visual/gpu/failure.h"
#include "visual/process/cost_of_moment.h"
#include "visual/process/run_loop.h"
#include "visual/process/versus.h"
#include "visual/scene/refine.h"
#include "visual/vulkan_devices.h"

namespace {

using namespace phare;

int refuse(const Error& error) {
  return fail("phare-visual", error);
}

nlohmann::json describe(const Lamps& lamps) {
  nlohmann::json tables = nlohmann::json::array();
  for (const Lamps::TableInfo& table : lamps.tables()) {
    tables.push_back({{"file", table.name},
                      {"content_hash", table.content_hash},
                      {"peak_cd", table.peak_cd},
                      {"flux_lm", table.flux_lm},
                      {"opening", table.opening},
                      {"notes", table.notes}});
    if (!table.reading.empty()) tables.back()["reading"] = table.reading;
  }
  return tables;
}

/// Adapted as the process was that this one takes the place of, if it does.
EyeAdaptation eye_of(const Session& session) {
  EyeAdaptation eye = eye_set(session.desk.eye);
  if (session.options.going_on && session.album.eye() && !eye.restore(*session.album.eye()))
    spdlog::warn("the eye's state of the process before is not whole; the eye begins adapted");
  return eye;
}

RendererOptions drawing_of(const VisualOptions& options, const Rig& rig) {
  RendererOptions drawing;
  drawing.width_px = options.width_px;
  drawing.height_px = options.height_px;
  drawing.samples = options.samples;
  drawing.validation = options.validation;
  drawing.beam_level = options.beam_image.value_or(rig.beam_image);
  drawing.device_name = options.device_name;
  return drawing;
}

/// Error: there is no device that draws so.
Result<Renderer> renderer_of(const RendererOptions& drawing, const Desk& desk) {
  Result<Renderer> renderer = Renderer::create(drawing);
  if (!renderer) return with_remedy(renderer.error());
  if (const auto reason = renderer->no_reference(); reason && desk.method == Method::kReference)
    return Error{"method reference", *reason + " (" + renderer->device() + ")"};
  return renderer;
}

/// Error where a moment that is asked for comes after the end of the drive.
Status moment_is_within(double at_s, double ends_s) {
  if (at_s <= ends_s) return Done{};
  return Error{"--still-at", fmt::format("{:g} s is after the end of the drive, {:.1f} s", at_s, ends_s)};
}

/// The device that would draw, and the moment of the options; a line for each effect. With --cost it does draw.
int explain_and_leave(const VisualOptions& options, const Rig& rig, Lamps& lamps, const Desk& desk,
                      const MomentScene& from, const std::shared_ptr<const FixedLight>& fixed) {
  AskedMoment moment, before;
  if (options.drive_file.empty()) {
    if (options.still_at_s >= 0.0) return refuse({"--still-at", "is a moment of a drive, and none is asked about"});
    before = moment = moment_at_rest(rig.scene_file, options.explain_light, options.explain_fog);
  } else {
    const Result<Drive> drive = read_drive(options.drive_file);
    if (!drive) return refuse(drive.error());
    const double ends_s = drive->duration.seconds();
    const double at_s = options.still_at_s < 0.0 ? 0.2 * ends_s : options.still_at_s;
    if (const Status within = moment_is_within(at_s, ends_s); !within) return refuse(within.error());
    Result<AskedMoment> asked = moment_of_drive(*drive, at_s);
    if (!asked) return refuse(asked.error());
    moment = std::move(*asked);
    const Result<AskedMoment> a_frame_earlier =
        moment_of_drive(*drive, at_s - 1.0 / static_cast<double>(rig.frame_rate_hz));
    before = a_frame_earlier ? *a_frame_earlier : moment;
  }
  if (options.explain_cost) {
    Result<Renderer> renderer = renderer_of(drawing_of(options, rig), desk);
    if (!renderer) return refuse(renderer.error());
    if (const Status loaded = renderer->load_scene(from.scene, from.movers.meshes(), fixed); !loaded)
      return refuse(loaded.error());
    const std::string costs = cost_of_moment(*renderer, lamps, desk, from,
                                             {.before = before,
                                              .moment = moment,
                                              .window = !options.headless,
                                              .lockstep = options.lockstep,
                                              .frames = options.frames > 0 ? options.frames : kCostFrames});
    std::fputs((moment_text(lamps, moment, renderer->device()) + costs).c_str(), stdout);
    if (renderer->validation_messages() == 0) return kExitDone;
    spdlog::error("{} Vulkan validation messages", renderer->validation_messages());
    return kExitCheckFailed;
  }
  const Result<VulkanDevice> device = vulkan_device(options.device_name);
  if (!device && !options.device_name.empty()) return refuse(with_remedy(device.error()));
  const std::string asked = device ? device->name : "no device (" + device.error().reason + ")";
  std::fputs(explain_moment(lamps, desk, from.channel, moment, asked, from.scene, from.movers, from.traffic, from.road,
                            from.fixed, !options.headless)
                 .c_str(),
             stdout);
  return kExitDone;
}

/// How far a scene is that takes longer to make ready than one waits for gladly, now and then.
Progress progress_line() {
  using Clock = std::chrono::steady_clock;
  static constexpr auto kEvery = std::chrono::seconds(2);
  return [next = Clock::now() + kEvery](double done_01, std::string_view what) mutable {
    if (Clock::now() < next) return;
    next = Clock::now() + kEvery;
    constexpr int kCells = 20;
    const auto filled = static_cast<std::size_t>(std::lround(kCells * std::clamp(done_01, 0.0, 1.0)));
    spdlog::info("{} [{}{}] {:.0f} %", what, std::string(filled, '#'), std::string(kCells - filled, '.'),
                 100.0 * done_01);
  };
}

/// Only in real time is there time to gain; channels that show one moment wait for each other, and a budget was
/// measured with one frame at a time. In a window a software device, which shows a picture with the very processors
/// that draw the next, gains nothing by it, and a driver would see the light 10 ms later.
Result<std::size_t> frames_in_flight(const VisualOptions& options, const Rig& rig) {
  if (options.lockstep || rig.channels.size() > 1 || options.budget_ms > 0.0) return std::size_t{1};
  if (options.frames_in_flight) return static_cast<std::size_t>(*options.frames_in_flight);
  if (options.headless) return std::size_t{2};
  const Result<VulkanDevice> device = vulkan_device(options.device_name);
  if (!device) return device.error();
  return std::size_t{device->software ? 1u : 2u};
}

/// Nothing is written before everything that can be wrong has been read.
int draw_channel(VisualOptions options) {
  Result<Rig> rig = read_rig(options.rig_file);
  if (!rig) return refuse(rig.error());
  if (options.port_base) rig->port_base = *options.port_base;
  if (options.open_bus) rig->run_key = false;
  if (options.channel >= rig->channels.size()) {
    return refuse({"--channel", "the rig has " + std::to_string(rig->channels.size()) + " channel(s), counted from 0"});
  }
  const ChannelConfig& channel = rig->channels[options.channel];
  if (options.width_px == 0) options.width_px = channel.width_px, options.height_px = channel.height_px;

  // The desk: as the rig has it, then as the command line says.
  Desk desk = rig->desk;
  for (const DeskCommand& command : options.desk) {
    if (const auto done = apply(desk, command, {.designs = rig->designs.size()}); !done) return refuse(done.error());
  }
  if (desk.compare != Compare::kOff && desk.design)
    if (const Status two = check_versus(desk, *desk.design); !two) return refuse(two.error());
  if (!options.levels.empty()) desk.method = options.levels[options.begin_level].method;
  Result<Lamps> lamps = Lamps::load(*rig);
  if (!lamps) return refuse(lamps.error());
  const Progress progress = progress_line();
  Result<Scene> scene = read_scene(rig->scene_file, progress);
  if (!scene) return refuse(scene.error());
  for (const std::string& note : scene->notes) spdlog::info("{}: {}", rig->scene_file.filename().string(), note);
  Result<std::vector<LanePoint>> lane = lane_beside(rig->scene_file);
  if (!lane) return refuse(lane.error());
  Result<Movers> movers = Movers::read();
  if (!movers) return refuse(movers.error());
  const Result<Props> props = Props::of(*movers);
  if (!props) return refuse(props.error());
  Result<Traffic> traffic = Traffic::read(options.traffic_file.value_or(rig->traffic_file), *lane, *movers);
  if (!traffic) return refuse(traffic.error());
  if (options.road_cuts > 0) scene = refined(*scene, options.road_cuts, is_ground);
  Result<FixedLight> fixed = FixedLight::of(*scene, rig->street_lamps_file, rig->moon);
  if (!fixed) return refuse(fixed.error());
  const auto fixed_light = std::make_shared<const FixedLight>(std::move(*fixed));
  if (options.explain)
    return explain_and_leave(
        options, *rig, *lamps, desk,
        {channel, *scene, *movers, *props, *traffic, RoadLine(*lane, rig->scene_file), *fixed_light}, fixed_light);
  LampReplay lamps_then;
  const double asked_s = options.still_at_s;
  double ends_s = std::numeric_limits<double>::infinity();  // as far as that is known
  if (options.lockstep && options.frames > 0)
    ends_s = static_cast<double>(options.frames) / static_cast<double>(rig->frame_rate_hz);
  if (!options.drive_file.empty()) {
    const Result<Drive> drive = read_drive(options.drive_file);
    if (!drive) return refuse(drive.error());
    ends_s = std::min(ends_s, drive->duration.seconds());
    if (options.still_at_s < 0.0) options.still_at_s = 0.2 * drive->duration.seconds();
    lamps_then = LampReplay(*drive);
  }
  if (const Status within = moment_is_within(asked_s, ends_s); !within) return refuse(within.error());

  std::optional<Window> window;
  if (!options.headless) {
    Result<Window> opened = Window::open(rig->channels.size() > 1 ? "Phare: " + channel.name : "Phare",
                                         options.width_px, options.height_px);
    if (!opened) return refuse(opened.error());
    window = std::move(*opened);
  }
  RendererOptions drawing = drawing_of(options, *rig);
  const Result<std::size_t> in_flight = frames_in_flight(options, *rig);
  if (!in_flight) return refuse(with_remedy(in_flight.error()));
  drawing.frames_in_flight = *in_flight;
  drawing.window = window ? window->handle() : nullptr;
  Result<Renderer> renderer = renderer_of(drawing, desk);
  if (!renderer) return refuse(renderer.error());
  if (const Status loaded = renderer->load_scene(*scene, movers->meshes(), fixed_light, progress); !loaded)
    return refuse(loaded.error());
  for (std::size_t beam = 0; beam < traffic->beams(); ++beam)
    renderer->set_beam(Traffic::kBeam + beam, traffic->beam(beam));

  if (const Status key = take_run_key(*rig); !key) return refuse(key.error());
  Result<Bus> bus = Bus::open(*rig, Role::kVisual, options.channel);
  if (!bus) return refuse(bus.error());
  const StopFlag stop = install_stop_signals();
  const Status ready = bus->ready_with_the_others(options.alive_file, [&] { return stop.requested(); });
  if (!ready) return refuse(ready.error());
  if (stop) return kExitDone;  // before the drive has begun: nothing is written
  Result<Album> album = options.out.empty() ? Result<Album>(Album{}) : Album::open(options.out, options.going_on);
  if (!album) return refuse(album.error());

  nlohmann::json lamps_json = describe(*lamps);
  Session session(std::move(options), std::move(*rig), std::move(desk), std::move(*scene), std::move(*lamps),
                  std::move(window), std::move(*renderer), std::move(*bus), std::move(*album), stop,
                  std::move(lamps_json));
  session.eye = eye_of(session);
  session.lamps_then = std::move(lamps_then);
  session.movers = std::move(*movers);
  session.props = *props;
  session.traffic = std::move(*traffic);
  session.fixed_light = fixed_light;
  session.lane = std::move(*lane);
  if (session.options.budget_ms > 0.0 && !session.options.lockstep && !session.options.levels.empty())
    session.governor = Governor(session.options.budget_ms, session.options.levels, session.options.begin_level);
  spdlog::info("drawing '{}' on {}, {}", session.channel().name, session.renderer.device(),
               session.renderer.frames_in_flight() == 1 ? "one frame at a time" : "two frames in flight");
  run_loop(session);
  // Under a launcher it is the launcher that ends with 1: one that ended so itself would be started again.
  if (session.album.not_kept() > 0 && session.options.alive_file.empty()) {
    spdlog::error("{} pictures could not be kept, first {}", session.album.not_kept(), session.album.first_not_kept());
    return kExitCheckFailed;
  }
  if (session.options.lockstep && session.audit.failure() && session.options.alive_file.empty()) {
    spdlog::error("self-audit: {}", session.audit.failure()->text());
    return kExitCheckFailed;
  }
  if (session.renderer.validation_messages() > 0) {
    spdlog::error("{} Vulkan validation messages", session.renderer.validation_messages());
    if (session.options.alive_file.empty()) return kExitCheckFailed;
  }
  return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  const ParsedOptions parsed = parse_options(argc, argv);
  if (!parsed.options) return end_of_output("phare-visual", parsed.exit_code);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("visual"));
  spdlog::set_level(spdlog::level::from_str(parsed.options->log_level));
  try {
    return end_of_output("phare-visual", draw_channel(*parsed.options));
  } catch (const std::exception& failure) {  // the device was lost, or memory ran out: say so once and leave
    spdlog::critical("phare-visual leaves: {}", gpu::reason_of(failure));
    return kExitCheckFailed;
  }
}
