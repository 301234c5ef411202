// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces.

/// @formula attenuation-moments
/// Moments of an exponential over the unit interval, accurate for every exponent.
///
/// symbol   unit   meaning
///   s       1      optical depth of the part, >= 0
///   m_n     1      integral over u from 0 to 1 of u^n e^(-s u)
///   N       1      highest n wanted
///   K       1      terms of (2)
/// @derivation
///   by parts:  m_n = (n m_{n-1} - e^-s) / s,  m_{n-1} = (s m_n + e^-s) / n                    (1)
///   m_N = e^-s sum over k of s^k / ((N+1) (N+2) ... (N+1+k)), all terms positive              (2)
///   For s <= N: (2), then downwards by (1): no difference is taken.                           (3)
///   For s > N: m_0 = (1 - e^-s) / s, then upwards by (1): n / s <= 1 lets no error grow.      (4)
/// @source    [UBT96] eq. (4) for (1) upwards; (2) is the series of Kummer's function M(1, N+2, s),
/// [AS64] 13.1.2
/// @deviation the paper goes upwards for every s > 0.1: at s = 1 and n = 8 that has 2 % error in float
/// @valid     s = 0 gives 1 / (n + 1); s = 1e30 gives n! / s^(n+1) or 0
/// @accuracy  8 eps for N = 4 and 8
/// @tests     tests/rendering/reference/integral/test_moments.cpp
template <class T>
constexpr int momentTerms(int highest)
{
    // Terms of (2) at s = N until they are below a quarter of a rounding.
    double term = 1.0, sum = 1.0;
    const double limit = Real<T>::kDigits > 100 ? 1e-36 : Real<T>::kDigits > 50 ? 2e-17 : 1e-8;
    int k = 1;
    for (; term > limit * sum; ++k) {
        term *= double(highest) / double(highest + 1 + k);
        sum += term;
    }
    return k;
}

template <class V, int kHighest>
HWY_INLINE void attenuationMoments(V s, V* outMoments)
{
    using T = typename Lanes<V>::Scalar;
    const V one = Lanes<V>::all(1);
    const V limit = Lanes<V>::all(T(kHighest));
    const V e = expOfMinus(s);
    const V clipped = smaller(s, limit);
    V sum = one; // (2), from the last term inwards
    constexpr int kTerms = momentTerms<T>(kHighest);
    for (int k = kTerms; k > 0; --k)
        sum = one + sum * clipped * Lanes<V>::all(T(1) / T(kHighest + 1 + k));
    outMoments[kHighest] = e * sum * Lanes<V>::all(T(1) / T(kHighest + 1));
    for (int n = kHighest; n > 0; --n) // (3)
        outMoments[n - 1] = (s * outMoments[n] + e) * Lanes<V>::all(T(1) / T(n));
    if (!anyLess(limit, s))
        return;
    V moment = (one - e) / s; // (4)
    outMoments[0] = chooseLess(limit, s, moment, outMoments[0]);
    for (int n = 1; n <= kHighest; ++n) {
        moment = larger((Lanes<V>::all(T(n)) * moment - e) / s, Lanes<V>::all(0));
        outMoments[n] = chooseLess(limit, s, moment, outMoments[n]);
    }
}
