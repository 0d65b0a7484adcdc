#include "config/road_surface_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "config/csv_table.h"

namespace phare {
namespace {

constexpr double kMaxPoints = 4e6;

// std::uniform_real_distribution may differ between libraries; these bits may not.
double uniform_01(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

double height_of(const Bump& bump, double s) {
  const double x = s - bump.start_m;
  switch (bump.shape) {
    case Bump::Shape::kCosine:
      if (x <= 0.0 || x >= bump.length_m) return 0.0;
      return 0.5 * bump.height_m * (1.0 - std::cos(2.0 * std::numbers::pi * x / bump.length_m));
    case Bump::Shape::kStep:
      return x >= 0.0 ? bump.height_m : 0.0;
    case Bump::Shape::kTrapezoid: {
      const double ramp = std::min(0.3, 0.5 * bump.length_m);
      return bump.height_m * std::clamp(std::min(x, bump.length_m - x) / ramp, 0.0, 1.0);
    }
  }
  return 0.0;
}

}  // namespace

double roughness_gd_m3(RoughnessClass roughness) {
  return 16e-6 * std::pow(4.0, static_cast<int>(roughness));
}

Result<RoughnessClass> parse_roughness(const std::string& text, const std::string& place) {
  if (text.size() == 1 && text[0] >= 'A' && text[0] <= 'E') return static_cast<RoughnessClass>(text[0] - 'A');
  return Error{place, "roughness \"" + text + "\" is not a class of ISO 8608 from A to E"};
}

Result<HeightProfile> HeightProfile::read(const std::filesystem::path& csv_file) {
  Result<CsvTable> table = CsvTable::read(csv_file);
  if (!table) return table.error();
  const auto column = [&](std::initializer_list<const char*> names) { return table->find(names); };
  const auto x = column({"x_m", "x", "s_m"}), both = column({"z_m", "z"});
  const auto left = both ? both : column({"z_left_m", "z_left"}),
             right = both ? both : column({"z_right_m", "z_right"});
  if (!x || !left || !right)
    return Error{csv_file.string() + ":1", "a height profile needs columns x_m and z_m, or x_m, z_left_m, z_right_m"};
  if (table->rows() < 2) return Error{csv_file.string(), "a height profile needs two rows at least"};
  double spacing = INFINITY;
  for (std::size_t row = 1; row < table->rows(); ++row) {
    const double step = table->at(row, *x) - table->at(row - 1, *x);
    if (!(step > 0.0)) return Error{table->place(row), "x_m does not rise"};
    spacing = std::min(spacing, step);
  }
  for (std::size_t row = 0; row < table->rows(); ++row)
    for (const std::size_t z : {*left, *right})
      if (std::abs(table->at(row, z)) > 1e4) return Error{table->place(row), "a height beyond 10 km is none of a road"};

  HeightProfile profile;
  const double from = table->at(0, *x), to = table->at(table->rows() - 1, *x);
  spacing = std::max(spacing, 1e-3);
  const double points = std::ceil((to - from) / spacing - 1e-6) + 1.0;
  if (points > kMaxPoints) return Error{csv_file.string(), "more than 4 million grid points"};
  profile.start_m_ = from;
  profile.spacing_m_ = (to - from) / (points - 1.0);
  profile.per_spacing_ = 1.0 / profile.spacing_m_;
  std::size_t row = 1;
  for (double i = 0; i < points; ++i) {
    const double s = from + profile.spacing_m_ * i;
    while (row + 1 < table->rows() && table->at(row, *x) < s) ++row;
    const double x0 = table->at(row - 1, *x), x1 = table->at(row, *x);
    const double u = std::clamp((s - x0) / (x1 - x0), 0.0, 1.0);
    profile.left_.push_back(std::lerp(table->at(row - 1, *left), table->at(row, *left), u));
    profile.right_.push_back(std::lerp(table->at(row - 1, *right), table->at(row, *right), u));
  }
  return profile;
}

HeightProfile HeightProfile::iso8608(RoughnessClass roughness, std::uint64_t seed, double length_m) {
  constexpr double kFrom = 0.011, kTo = 2.83, kReference = 0.1;  // cycles/m, ISO 8608
  HeightProfile profile;
  profile.repeats_ = true;
  profile.spacing_m_ = 0.05;
  profile.per_spacing_ = 20.0;
  const auto points = static_cast<std::size_t>(std::round(length_m / profile.spacing_m_));
  const double period = static_cast<double>(points) * profile.spacing_m_, dn = 1.0 / period;
  profile.per_count_ = 1.0 / static_cast<double>(points);
  profile.left_.assign(points, 0.0);
  profile.right_.assign(points, 0.0);
  std::mt19937_64 random(seed);
  const double gd = roughness_gd_m3(roughness);
  // A sine per line of the spectrum, its amplitude fixed, its phase random; a rotation per point instead of a sine.
  for (double k = std::ceil(kFrom * period); k <= kTo * period; ++k) {
    const double n = k * dn;
    const double amplitude = std::sqrt(2.0 * gd * std::pow(n / kReference, -2.0) * dn);
    const double alike = std::exp(-2.8 * n), apart = std::sqrt(1.0 - alike * alike);
    const double phase = 2.0 * std::numbers::pi * uniform_01(random);
    const double other = 2.0 * std::numbers::pi * uniform_01(random);
    double c = std::cos(phase), s = std::sin(phase), oc = std::cos(other), os = std::sin(other);
    const double turn = 2.0 * std::numbers::pi * n * profile.spacing_m_, tc = std::cos(turn), ts = std::sin(turn);
    for (std::size_t i = 0; i < points; ++i) {
      profile.left_[i] += amplitude * c;
      profile.right_[i] += amplitude * (alike * c + apart * oc);
      const double next = c * tc - s * ts, other_next = oc * tc - os * ts;
      s = s * tc + c * ts, c = next;
      os = os * tc + oc * ts, oc = other_next;
    }
  }
  return profile;
}

HeightProfile HeightProfile::bumps(const std::vector<Bump>& bumps) {
  HeightProfile profile;
  if (bumps.empty()) return profile;
  profile.spacing_m_ = 0.005;
  profile.per_spacing_ = 200.0;
  double from = INFINITY, to = -INFINITY;
  for (const Bump& bump : bumps) {
    from = std::min(from, bump.start_m - 1.0);
    to = std::max(to, bump.start_m + (bump.shape == Bump::Shape::kStep ? 0.0 : bump.length_m) + 1.0);
  }
  profile.start_m_ = from;
  const auto points = static_cast<std::size_t>(std::min((to - from) / profile.spacing_m_, kMaxPoints)) + 2;
  for (std::size_t i = 0; i < points; ++i) {
    const double s = from + profile.spacing_m_ * static_cast<double>(i);
    double left = 0.0, right = 0.0;
    for (const Bump& bump : bumps) {
      const double height = height_of(bump, s);
      left += bump.left ? height : 0.0;
      right += bump.right ? height : 0.0;
    }
    profile.left_.push_back(left);
    profile.right_.push_back(right);
  }
  return profile;
}

void HeightProfile::smooth(double contact_length_m) {
  const auto half = static_cast<std::ptrdiff_t>(std::round(0.5 * contact_length_m / spacing_m_));
  if (half < 1 || left_.size() < 2) return;
  const auto count = static_cast<std::ptrdiff_t>(left_.size());
  for (std::vector<double>* track : {&left_, &right_}) {
    const std::vector<double> before = *track;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      double sum = 0.0;
      for (std::ptrdiff_t j = i - half; j <= i + half; ++j) {
        const std::ptrdiff_t at = repeats_ ? (j % count + count) % count : std::clamp<std::ptrdiff_t>(j, 0, count - 1);
        sum += before[static_cast<std::size_t>(at)];
      }
      (*track)[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * half + 1);
    }
  }
}

HeightProfile::Sample HeightProfile::at(double s_m, bool left) const {
  const std::vector<double>& track = left ? left_ : right_;
  const std::int64_t count = points();
  double place = (s_m - start_m_) * per_spacing_;
  // Written so that NaN fails.
  if (count < 2 || !(std::abs(place) < 1e15)) return {};
  if (repeats_) {
    // By truncation: floor() is a call where the processor's own is not assumed.
    place -= static_cast<double>(static_cast<std::int64_t>(place * per_count_)) * static_cast<double>(count);
    if (place < 0.0) place += static_cast<double>(count);
  } else if (place <= 0.0) {
    return {track.front(), 0.0};
  } else if (place >= static_cast<double>(count - 1)) {
    return {track.back(), 0.0};
  }
  const auto i = std::min(static_cast<std::int64_t>(place), count - 1);
  const double u = place - static_cast<double>(i);
  std::array<double, 4> z;
  if (i >= 1 && i + 2 < count) {
    for (std::size_t k = 0; k < 4; ++k) z[k] = track[static_cast<std::size_t>(i) - 1 + k];
  } else {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t at = i - 1 + static_cast<std::int64_t>(k);
      z[k] =
          track[static_cast<std::size_t>(repeats_ ? (at + count) % count : std::clamp<std::int64_t>(at, 0, count - 1))];
    }
  }
  // Catmull and Rom 1974: the cubic with the slopes of the neighbours' chords.
  const double slope_b = 0.5 * (z[2] - z[0]), slope_c = 0.5 * (z[3] - z[1]);
  const double c2 = 3.0 * (z[2] - z[1]) - 2.0 * slope_b - slope_c, c3 = slope_b + slope_c - 2.0 * (z[2] - z[1]);
  return {z[1] + u * (slope_b + u * (c2 + u * c3)), (slope_b + u * (2.0 * c2 + 3.0 * u * c3)) * per_spacing_};
}

}  // namespace phare
