// Sine and cosine of a part of a turn, from + - * / and floor only. Libraries differ in the last
// bit of std::sin, and a scene must be the same mesh everywhere.
#pragma once

namespace assay::corpus {

inline constexpr double pi = 3.14159265358979323846;

// sin(2 pi x) and cos(2 pi x) for |x| < 2^40, within 4e-16; exact at multiples of a quarter turn.
double sin_turn(double x);
double cos_turn(double x);

}  // namespace assay::corpus
