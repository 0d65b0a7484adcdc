#include "vehicle_dynamics/traces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phare::batch {
namespace {

constexpr std::size_t kMostPieces = 2000, kNumbers = sizeof(Row) / sizeof(double);

#define PHARE_AT(member) (offsetof(Row, member) / sizeof(double))

std::vector<Quantity> of_wheels(std::size_t at, std::array<const char*, 4> columns,
                                std::array<const char*, 4> aliases) {
  constexpr const char* kLegends[] = {"front left", "front right", "rear left", "rear right"};
  std::vector<Quantity> lines;
  for (std::size_t i = 0; i < 4; ++i) lines.push_back({columns[i], aliases[i], kLegends[i], at + i});
  return lines;
}
constexpr std::array<const char*, 4> kNone{nullptr, nullptr, nullptr, nullptr};

double number(const Row& row, std::size_t at) {
  return (&row.time_s)[at];
}

}  // namespace

const std::vector<Panel>& panels() {
  constexpr double kDeg = 180.0 / std::numbers::pi;
  static const std::vector<Panel> kPanels{
      {"Speed", "km/h", 3.6, 0, false, {{"vx_mps", "vx", "along the car", PHARE_AT(vx_mps)}}},
      {"Acceleration",
       "m/s²",
       1.0,
       0,
       false,
       {{"ax_mps2", "ax", "along", PHARE_AT(ax_mps2)}, {"ay_mps2", "ay", "to the left", PHARE_AT(ay_mps2)}}},
      {"Pitch, nose down > 0", "deg", kDeg, 0, false, {{"pitch_rad", "pitch", "body", PHARE_AT(pitch_rad)}}},
      {"Roll, right side down > 0", "deg", kDeg, 0, false, {{"roll_rad", "roll", "body", PHARE_AT(roll_rad)}}},
      {"Height of the centre of gravity over rest", "mm", 1e3, 0, false, {{"z_m", "z", "body", PHARE_AT(z_m)}}},
      {"Yaw rate, left > 0",
       "deg/s",
       kDeg,
       0,
       false,
       {{"yaw_rate_radps", "yaw_rate", "car", PHARE_AT(yaw_rate_radps)}}},
      {"Cut-off on a wall 25 m ahead, above the road",
       "m",
       1.0,
       0,
       true,
       {{"cutoff_25m_m", nullptr, "cut-off", PHARE_AT(cutoff_25m_m)}}},
      {"Lamps by levelling, up > 0",
       "deg",
       kDeg,
       0,
       true,
       {{"lamp_tilt_rad", nullptr, "lamps", PHARE_AT(lamp_tilt_rad)}}},
      {"Load of the wheels", "kN", 1e-3, 0, false,
       of_wheels(PHARE_AT(fz_n), {"fz_fl_n", "fz_fr_n", "fz_rl_n", "fz_rr_n"}, {"Fz_FL", "Fz_FR", "Fz_RL", "Fz_RR"})},
      {"Steering at the road wheels, left > 0",
       "deg",
       kDeg,
       kDriver,
       false,
       {{"steer_rad", "delta", "mean of the front wheels", PHARE_AT(steer_rad)}}},
      {"Pedals",
       "%",
       100.0,
       kDriver,
       false,
       {{"accelerator_01", nullptr, "accelerator", PHARE_AT(accelerator_01)},
        {"brake_01", nullptr, "brake", PHARE_AT(brake_01)}}},
      {"Slip along", "%", 100.0, kSlip, false,
       of_wheels(PHARE_AT(slip), {"slip_fl", "slip_fr", "slip_rl", "slip_rr"}, kNone)},
      {"Slip angle", "deg", kDeg, kSlipAngle, false,
       of_wheels(PHARE_AT(slip_angle_rad),
                 {"slip_angle_fl_rad", "slip_angle_fr_rad", "slip_angle_rl_rad", "slip_angle_rr_rad"}, kNone)},
      {"Travel towards the body", "mm", 1e3, kTravel, false,
       of_wheels(PHARE_AT(travel_m), {"travel_fl_m", "travel_fr_m", "travel_rl_m", "travel_rr_m"}, kNone)},
      {"Drive torque", "N m", 1.0, kTorque, false,
       of_wheels(PHARE_AT(drive_nm), {"drive_fl_nm", "drive_fr_nm", "drive_rl_nm", "drive_rr_nm"}, kNone)},
      {"Brake torque", "N m", 1.0, kTorque, false,
       of_wheels(PHARE_AT(brake_nm), {"brake_fl_nm", "brake_fr_nm", "brake_rl_nm", "brake_rr_nm"}, kNone)},
      {"Friction used", "%", 100.0, kFrictionUsed, false,
       of_wheels(PHARE_AT(friction_used_01),
                 {"friction_used_fl_01", "friction_used_fr_01", "friction_used_rl_01", "friction_used_rr_01"}, kNone)},
      {"Engine", "1/min", 1.0, kGear, false, {{"engine_rpm", nullptr, "speed", PHARE_AT(engine_rpm)}}},
      {"Gear", "", 1.0, kGear, false, {{"gear", nullptr, "gear", PHARE_AT(gear)}}},
      {"Energy",
       "kJ",
       1e-3,
       kEnergy,
       false,
       {{"car_j", nullptr, "car has", PHARE_AT(car_j)},
        {"engine_j", nullptr, "engine gave", PHARE_AT(engine_j)},
        {"brakes_j", nullptr, "brakes took", PHARE_AT(brakes_j)},
        {"tyres_j", nullptr, "tyres took", PHARE_AT(tyres_j)}}},
      {"Level: 0 kinematic, 1 single-track, 2 full",
       "",
       1.0,
       kLevel,
       false,
       {{"level", nullptr, "level", PHARE_AT(level)}}},
  };
  return kPanels;
}

#undef PHARE_AT

Result<ReferenceRun> read_reference_run(const std::filesystem::path& file) {
  const Result<CsvTable> table = CsvTable::read(file);
  if (!table) return table.error();
  const auto time = table->find({"time_s", "t"});
  if (!time) return Error{file.string() + ":" + std::to_string(table->header_line()), "has no column time_s or t"};
  ReferenceRun run;
  run.name = file.filename().string();
  const auto column = [&](std::size_t at) {
    std::vector<double> values;
    for (std::size_t row = 0; row < table->rows(); ++row) values.push_back(table->at(row, at));
    return values;
  };
  run.time_s = column(*time);
  for (std::size_t row = 1; row < run.time_s.size(); ++row)
    if (!(run.time_s[row] > run.time_s[row - 1])) return Error{table->place(row), "time does not rise"};
  for (const Panel& panel : panels())
    for (const Quantity& line : panel.lines)
      if (const auto at = table->find({line.column, line.alias ? line.alias : line.column}))
        run.columns[line.column] = column(*at);
  if (const auto x = table->find({"x_m", "X"}), y = table->find({"y_m", "Y"}); x && y)
    run.columns["x_m"] = column(*x), run.columns["y_m"] = column(*y);
  if (run.columns.empty())
    return Error{file.string() + ":" + std::to_string(table->header_line()),
                 "has no column that a page shows: see the columns of OUT"};
  return run;
}

Traces::Traces(bool lamps, unsigned columns, const ReferenceRun* reference)
    : lamps_(lamps), columns_(columns), reference_(reference) {}

bool Traces::shows(const Panel& panel) const {
  return (!panel.lamps || lamps_) && (panel.only_with == 0 || (columns_ & panel.only_with) != 0);
}

const Difference* Traces::difference(const Quantity& quantity) const {
  const auto found = differences_.find(quantity.column);
  return found == differences_.end() || found->second.count == 0 ? nullptr : &found->second;
}

void Traces::add(const Row& row) {
  if (reference_) compare(row);
  if (pieces_.empty() || rows_in_last_ == rows_per_piece_) {
    if (pieces_.size() == kMostPieces) {  // two become one
      for (std::size_t i = 0; i < kMostPieces / 2; ++i) {
        Piece &kept = pieces_[i] = pieces_[2 * i], &other = pieces_[2 * i + 1];
        kept.to_s = other.to_s;
        for (std::size_t n = 0; n < kNumbers; ++n)
          kept.least[n] = std::min(kept.least[n], other.least[n]),
          kept.largest[n] = std::max(kept.largest[n], other.largest[n]);
      }
      pieces_.resize(kMostPieces / 2);
      rows_per_piece_ *= 2;
    }
    rows_in_last_ = 0;
    Piece piece{row.time_s, row.time_s, std::vector<float>(kNumbers), {}};
    for (std::size_t n = 0; n < kNumbers; ++n) piece.least[n] = static_cast<float>(number(row, n));
    piece.largest = piece.least;
    pieces_.push_back(std::move(piece));
  }
  ++rows_in_last_;
  Piece& last = pieces_.back();
  last.to_s = row.time_s;
  for (std::size_t n = 0; n < kNumbers; ++n) {
    const auto value = static_cast<float>(number(row, n));
    last.least[n] = std::min(last.least[n], value), last.largest[n] = std::max(last.largest[n], value);
  }
}

// Linear between two rows, at the reference's own times.
void Traces::compare(const Row& row) {
  const std::vector<double>& times = reference_->time_s;
  if (!before_) before_ = row;
  while (next_ < times.size() && times[next_] < before_->time_s) ++next_;
  for (; next_ < times.size() && times[next_] <= row.time_s; ++next_) {
    const double span = row.time_s - before_->time_s, u = span > 0.0 ? (times[next_] - before_->time_s) / span : 1.0;
    for (const Panel& panel : panels())
      for (const Quantity& line : panel.lines) {
        const auto found = shows(panel) ? reference_->columns.find(line.column) : reference_->columns.end();
        if (found == reference_->columns.end()) continue;
        const double ours = std::lerp(number(*before_, line.at), number(row, line.at), u),
                     theirs = found->second[next_];
        Difference& d = differences_[line.column];
        if (std::abs(ours - theirs) > d.largest) d.largest = std::abs(ours - theirs), d.at_s = times[next_];
        d.sum_of_squares += (ours - theirs) * (ours - theirs);
        d.peak = std::max(d.peak, std::abs(theirs));
        ++d.count;
      }
  }
  before_ = row;
}

}  // namespace phare::batch
