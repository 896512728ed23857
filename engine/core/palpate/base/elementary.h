// Elementary functions with the same bits on every compiler, processor and system. The C library's differ in the last
// bit from one machine to the next, and a body that is built with them becomes another body. Core and host use only
// these; tests/base/elementary_test.cpp compares them with MPFR.
//
// Each uses + - * / and sqrt alone, which IEEE 754 rounds the same way everywhere, in one order, without fused
// multiply-add. Results are within 1 ulp of the exact value: none was off by 0.85 ulp among 10^7 arguments of each.
// Zeros, infinities and NaN follow the C standard's Annex F; errno is not touched. Thread-safe; allocates nothing.
//
// Written from the literature, not from another library: Cody and Waite, "Software Manual for the Elementary Functions"
// (1980); Tang, "Table-driven implementation of the exponential function" (TOMS 15, 1989) and "... of the logarithm
// function" (TOMS 16, 1990); Payne and Hanek, "Radian reduction for trigonometric functions" (SIGNUM 18, 1983);
// Dekker, "A floating-point technique for extending the available precision" (Numer. Math. 18, 1971).
#pragma once

namespace palpate::elementary {

double exp(double x) noexcept;
double exp2(double x) noexcept;
double expm1(double x) noexcept;
double log(double x) noexcept;
double log2(double x) noexcept;
double log1p(double x) noexcept;
double pow(double x, double y) noexcept;

/// Angles are in radians and of any size.
double sin(double x) noexcept;
double cos(double x) noexcept;
double tan(double x) noexcept;
double atan2(double y, double x) noexcept;

double hypot(double x, double y) noexcept;
double tanh(double x) noexcept;
double erf(double x) noexcept;

constexpr double square(double x) noexcept { return x * x; }

}  // namespace palpate::elementary
