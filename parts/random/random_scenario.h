#pragma once

#include <cstdint>

#include "model/scenario.h"
#include "parts/random/random_recipe.h"

namespace ursula {

/// Returns a valid scenario from a seed, the same on every machine. Most numbers are moderate. Each kind of extreme has
/// its own probability, so a scenario has some two, which `text` names. No two legs share a non-zero number. L is the
/// machine's length, m its mass, a its acceleration (|g|, even without gravity), T = √(L/a) its time. The ranges are:
///
///   L                        0.4 m to 4 m; 2 mm to 300 m
///   m                        1 to 15 times L³ kg/m³; 1 g to 1 t whatever the size
///   gravity                  9.8 m/s², down within some degrees; 1.6 to 274 m/s²; none, tilted any way, up, sideways
///   masses                   platform 1 to 50 m, links m/2 to 2 m; both apart over six decades; every link's own over
///                            six decades
///   mass centres of links    0.2 to 0.8 of the length; -1.5 to 2.5 of it, at the ends exactly and nearly
///   ρ of the platform        up to L from its points; up to 10 L
///   inertias                 solid; points from 10⁻⁶ m l² on; rods (two extents 10⁻³ of the third or less); laminae
///                            (triangle inequality to 10⁻⁴ … 10⁻¹²); each body its own kind; turned any way
///   base points              pairs as in Table I, rings, pairs shared at both ends or at the platform's, no order; the
///                            platform over or under the base; turned any way in B; L from the origin, up to
///                            100 km and 10⁶ L
///   platform points          P among them; up to 30 L off; M turned any way
///   axes                     tilted tangents, radial, tangential, random, one along z exactly or nearly; any length
///   links                    l / s from 2/3 to 3/2; 1/5 to 5; crank over the rod as seen along the axis likewise
///   knees                    either way, between 20° and 160° in the middle of the motion
///   friction                 none, viscous, Coulomb's, both; each leg's own, up to half (a fifth for Coulomb's) of the
///                            weight that it carries; smoothing speed 0.003 to 0.3 rad over T
///   rotors                   of a quarter of the machines, 0.003 to 3 times the rod's m s² (for sliding ones m)
///   loads                    none, constant, tabulated with 2 to 7 rows, 1 to 3 jumps within 0.001 T to 0.01 T;
///                            0.01 to 2 weights; acting up to 0.7 L or 10 L from the platform's points; in both frames
///   motions                  helices at rest or moving at their ends, holds, 2 to 5 waypoints, 8 to 24 tight ones,
///                            some abrupt (intervals 1 : 20), 7 to 40 samples, up to 120, noisy ones
///   extent                   0.05 to 0.2 L and 0.05 to 0.3 rad or as much as the legs can follow
///   duration                 1 to 8 T; 0.02 to 60 T
///   singularities            κ(B) κ(legs) up to 10⁴; 10⁴ to 10⁶; legs down to |sin θ| = 0.03, B down to |AB| / 20 from
///                            its leg's axis
///
/// and for other kinds than URS:
///
///   legs                     six of one kind; four to six of any kinds; three to five, some with two motors or three
///   motors                   on the coordinate that a kind drives by default; on any
///   strokes (UPS)            0.15 to 0.85 of it used in the middle of the motion; 0.003 to 0.05 from an end
///   rods (PUS)               20° to 70° to the rail; 78° to 87°; the carriage up to 30 L from its zero
///   friction                 of sliding coordinates as of rotating ones, with L as the lever
///
/// Every leg follows the whole motion, and det B keeps its sign.
Scenario randomScenario(std::uint64_t seed, RandomKind kind = RandomKind::URS);

}  // namespace ursula
