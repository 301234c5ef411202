#include "quad.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace fx::render::integral {
namespace {

/// e^-s M(1, n + 2, s) / (n + 1) by its series up to s = 60, beyond that by the forward recurrence, which
/// there loses nothing.
template <int kHighest>
std::array<Quad, kHighest + 1> trueMoments(Quad s)
{
    std::array<Quad, kHighest + 1> m;
    if (s > Quad(60)) {
        m[0] = -expm1q(-s) / s;
        for (int n = 1; n <= kHighest; ++n)
            m[n] = (Quad(n) * m[n - 1] - expq(-s)) / s;
        return m;
    }
    for (int n = 0; n <= kHighest; ++n) {
        Quad sum = Quad(0), term = Quad(1) / Quad(n + 1);
        for (int k = 1; term > Quad(1e-37) * sum; ++k) {
            sum += term;
            term *= s / Quad(n + 1 + k);
        }
        m[n] = expq(-s) * sum;
    }
    return m;
}

/// Largest error over all n and s, in units of 2^-24 or 2^-53.
template <class T, int kHighest>
double worstMoment(void (*moments)(T, T*), double least, double most)
{
    double worst = 0.0;
    for (double exponent = least; exponent <= most; exponent += 0.05) {
        const T s = static_cast<T>(std::pow(10.0, exponent));
        const std::array<Quad, kHighest + 1> exact = trueMoments<kHighest>(Quad(s));
        T got[kHighest + 1];
        moments(s, got);
        for (int n = 0; n <= kHighest; ++n)
            if (exact[n] > Quad(1e-30)) {
                const double error = std::fabs(double((Quad(got[n]) - exact[n]) / exact[n]));
                worst = error <= worst ? worst : error;
            }
    }
    return worst * std::ldexp(1.0, std::numeric_limits<T>::digits);
}

/// The textbook recurrence, as the paper gives it.
template <class T, int kHighest>
void naiveMoments(T s, T* m)
{
    m[0] = -std::expm1(-s) / s;
    for (int n = 1; n <= kHighest; ++n)
        m[n] = (T(n) * m[n - 1] - std::exp(-s)) / s;
}

/// attenuationMoments() is always inlined, and so has no address.
template <class T, int kHighest>
void momentsOf(T s, T* m)
{
    attenuationMoments<T, kHighest>(s, m);
}

TEST(AttenuationMoments, areWithinEightRoundingsForEveryExponent)
{
    EXPECT_LT((worstMoment<float, 4>(momentsOf<float, 4>, -30, 4)), 8.0);
    EXPECT_LT((worstMoment<float, 8>(momentsOf<float, 8>, -30, 4)), 10.0);
    EXPECT_LT((worstMoment<double, 4>(momentsOf<double, 4>, -30, 4)), 8.0);
    EXPECT_LT((worstMoment<double, 8>(momentsOf<double, 8>, -30, 4)), 10.0);
}

TEST(AttenuationMoments, ofKernelsOfHigherDegreeAreNearlyAsGood)
{
    EXPECT_LT((worstMoment<float, 1>(momentsOf<float, 1>, -30, 4)), 8.0);
    EXPECT_LT((worstMoment<float, 6>(momentsOf<float, 6>, -30, 4)), 10.0);
    EXPECT_LT((worstMoment<float, 12>(momentsOf<float, 12>, -30, 4)), 16.0);
    EXPECT_LT((worstMoment<float, 16>(momentsOf<float, 16>, -30, 4)), 16.0);
    EXPECT_LT((worstMoment<double, 16>(momentsOf<double, 16>, -30, 4)), 16.0);
}

TEST(AttenuationMoments, ofTheTextbookRecurrenceAreUseless)
{
    EXPECT_GT((worstMoment<float, 8>(naiveMoments<float, 8>, 0, 0)), 1e4);    // per mille at s = 1
    EXPECT_GT((worstMoment<float, 8>(naiveMoments<float, 8>, -1, -1)), 1e10); // nothing is left at s = 0.1
    EXPECT_GT((worstMoment<double, 8>(naiveMoments<double, 8>, -1, -1)), 1e6);
}

TEST(AttenuationMoments, ofNoAttenuationAreThoseOfThePowers)
{
    for (const float s : {0.0f, -0.0f}) {
        float m[9];
        attenuationMoments<float, 8>(s, m);
        for (int n = 0; n <= 8; ++n)
            EXPECT_NEAR(m[n], 1.0f / float(n + 1), 4e-8f);
    }
}

TEST(AttenuationMoments, ofNoAttenuationHaveNoValueInTheTextbookRecurrence)
{
    float m[9];
    naiveMoments<float, 8>(0.0f, m);
    EXPECT_TRUE(std::isnan(m[0])); // 0/0
}

TEST(AttenuationMoments, fallFromOneToTheNextAndStayFinite)
{
    for (float s = 1e-30f; s < 1e30f; s *= 3.0f) {
        float m[9];
        attenuationMoments<float, 8>(s, m);
        for (int n = 0; n <= 8; ++n) {
            EXPECT_TRUE(std::isfinite(m[n])) << s;
            EXPECT_GE(m[n], 0.0f) << s;
            EXPECT_LE(m[n], n == 0 ? 1.000001f : m[n - 1]) << s << ' ' << n;
        }
    }
}

} // namespace
} // namespace fx::render::integral
