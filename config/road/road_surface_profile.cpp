#include "config/road/road_surface_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "config/formats/csv_table.h"

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
  profile.grid_.resize(static_cast<std::size_t>(points) + kMargin);
  std::size_t row = 1;
  for (std::int64_t i = 0; i < profile.points(); ++i) {
    const double s = from + profile.spacing_m_ * static_cast<double>(i);
    while (row + 1 < table->rows() && table->at(row, *x) < s) ++row;
    const double x0 = table->at(row - 1, *x), x1 = table->at(row, *x);
    const double u = std::clamp((s - x0) / (x1 - x0), 0.0, 1.0);
    profile.point(i) = Two{std::lerp(table->at(row - 1, *left), table->at(row, *left), u),
                           std::lerp(table->at(row - 1, *right), table->at(row, *right), u)};
  }
  profile.fill_margin();
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
  profile.grid_.resize(points + kMargin);
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
    for (std::int64_t i = 0; i < profile.points(); ++i) {
      profile.point(i)[0] += amplitude * c;
      profile.point(i)[1] += amplitude * (alike * c + apart * oc);
      const double next = c * tc - s * ts, other_next = oc * tc - os * ts;
      s = s * tc + c * ts, c = next;
      os = os * tc + oc * ts, oc = other_next;
    }
  }
  profile.fill_margin();
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
  profile.grid_.resize(points + kMargin);
  for (std::int64_t i = 0; i < profile.points(); ++i) {
    const double s = from + profile.spacing_m_ * static_cast<double>(i);
    double left = 0.0, right = 0.0;
    for (const Bump& bump : bumps) {
      const double height = height_of(bump, s);
      left += bump.left ? height : 0.0;
      right += bump.right ? height : 0.0;
    }
    profile.point(i) = Two{left, right};
  }
  profile.fill_margin();
  return profile;
}

void HeightProfile::smooth(double contact_length_m) {
  const auto half = static_cast<std::ptrdiff_t>(std::round(0.5 * contact_length_m / spacing_m_));
  const std::int64_t count = points();
  if (half < 1 || count < 2) return;
  const std::vector<Point> before = grid_;
  for (std::int64_t i = 0; i < count; ++i) {
    Two sum{};
    for (std::int64_t j = i - half; j <= i + half; ++j) {
      const std::int64_t at = repeats_ ? (j % count + count) % count : std::clamp<std::int64_t>(j, 0, count - 1);
      sum += before[static_cast<std::size_t>(at + 1)].z_m;
    }
    point(i) = sum / static_cast<double>(2 * half + 1);
  }
  fill_margin();
}

void HeightProfile::fill_margin() {
  const std::int64_t count = points();
  if (count < 1) return;
  if (repeats_) {
    point(-1) = point(count - 1), point(count) = point(0), point(count + 1) = point(1 % count);
    return;
  }
  // Straight on, so that the cubic has the slope of its last cell at an end and a straight profile is straight.
  const Two first = point(0), last = point(count - 1);
  point(-1) = count > 1 ? first + first - point(1) : first;
  point(count) = count > 1 ? last + last - point(count - 2) : last;
  point(count + 1) = point(count);
}

}  // namespace phare
