// Rain and snow as headlamps show them: how many drops or flakes of which size, how fast they fall, how much of a beam
// they take, and where they send it. Float64.
//
// Rain: N(D) = 8000·exp(−4.1·R^−0.21·D) per m³ and mm (Marshall and Palmer 1948), falling at 9.65 − 10.3·exp(−0.6·D)
// m/s (Atlas et al. 1973), D in mm, R in mm/h. Extinction 0.365·R^0.63 per km counts what a drop bends away by
// diffraction, which is as much again as it meets (Q = 2, LOWTRAN 7); that goes on within 0.03° of the beam and lights
// what the beam lights, so half of it is taken here. What is taken is scattered as by Henyey and Greenstein with g
// 0.70: 0.0083 per sr straight back, where Mie's theory has 0.009 over 160° to 180°.
//
// Snow, S in mm/h of water, dry: extinction 4.92·S per km (Rasmussen et al. 1999), half of it taken as above; N(D) of
// melted diameters 3800·S^−0.87·exp(−2.55·S^−0.48·D) (Gunn and Marshall 1958); 1 m/s. Flakes send light everywhere
// alike: a lidar ratio of 25 sr. Unconfirmed: the size of a flake, taken such that the flakes meet what the extinction
// says, and that ratio. Visibility at one rate of snow scatters by 3 to 10 times anyway.
//
// Left out: wind, drops that break up, light that is scattered twice, melting snow.
// Checked by tests/photometry/precipitation_test.cpp.
#pragma once

#include <array>
#include <cstddef>

namespace phare {

enum class Precipitation { kRain, kSnow };

/// Of one kind at one rate. Number per m³ and mm of diameter: n0·exp(−slope·D).
struct Particles {
  Precipitation kind = Precipitation::kRain;
  double n0_per_m3mm = 0.0;
  double slope_per_mm = 1.0;
  double scattering_per_m = 0.0;  ///< taken from a beam and scattered, diffraction left out
  double area_factor = 1.0;       ///< a particle meets this times pi/4·D² of a beam
  double g = 0.0;                 ///< Henyey and Greenstein's

  /// Larger than `diameter_mm`, in a m³.
  double number_per_m3(double diameter_mm = 0.0) const;
  /// Of what all scatter, the share of those larger than `diameter_mm`.
  double share_of_larger(double diameter_mm) const;
};

/// `rate_mmph` > 0, of water.
Particles particles_of(Precipitation kind, double rate_mmph);

/// Terminal speed; drops below 0.5 mm, where the formula ends: even down to none.
double fall_mps(Precipitation kind, double diameter_mm);

/// How long an eye or a camera sums light of what moves: a drop is a streak as long as it moves in that time.
inline constexpr double kExposure_s = 1.0 / 60.0;

/// Drops that are drawn one by one: by size in classes, the smaller the nearer they are drawn, so that their number is
/// bounded at any rate. Each class repeats in the world in cubes of its size, one of which lies before the eye.
struct DropClass {
  double cube_m = 0.0;    ///< edge of its cube
  double least_mm = 0.0;  ///< diameters from here
  double most_mm = 0.0;   ///< to here; infinity for the class of the largest
  std::size_t count = 0;  ///< in the cube, kMostDrops at most
  double share = 0.0;     ///< of what all scatter
};
inline constexpr std::size_t kDropClasses = 3, kMostDrops = 4096;
/// Smallest drops first, with the smallest cube.
std::array<DropClass, kDropClasses> drop_classes(const Particles& particles);

}  // namespace phare
