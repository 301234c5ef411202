// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces, after blob_sums.inl.
// Light and optical depth of one part of an interval, from its polynomials.

/// What a group of rays has got so far.
template <class V>
struct Gathered
{
    V light[3];
    V depth;
    V fallback; ///< 1 in lanes that used depth-linear-source beyond the cap

    HWY_INLINE void clear() { light[0] = light[1] = light[2] = depth = fallback = Lanes<V>::all(0); }
};

/// Optical depth from the expansion point to x: the odd and the even powers of x apart.
template <class V, int kTerms>
struct DepthPolynomial
{
    using T = typename Lanes<V>::Scalar;
    V c[kTerms];

    HWY_INLINE explicit DepthPolynomial(const V* density)
    {
        c[0] = density[0];
        for (int k = 1; k < kTerms; ++k)
            c[k] = density[k] * Lanes<V>::all(T(1) / T(k + 1));
    }
    HWY_INLINE V odd(V x, V xx) const
    {
        V sum = c[kTerms - 1];
        for (int k = kTerms - 3; k >= 0; k -= 2)
            sum = sum * xx + c[k];
        return sum * x;
    }
    HWY_INLINE V even(V xx) const
    {
        V sum = c[kTerms - 2];
        for (int k = kTerms - 4; k >= 0; k -= 2)
            sum = sum * xx + c[k];
        return sum * xx;
    }
    HWY_INLINE V at(V x) const { return odd(x, x * x) + even(x * x); }
};

/// How many moments a source needs: it has the kernel's degree, or twice that.
template <int kTerms, bool kProduct>
inline constexpr int kMomentCount = kProduct ? 2 * kTerms - 1 : kTerms;

/// In the product model the extinction is part of what attenuation's moments are weighed with: turns the
/// moments of e^-tau into those of rho e^-tau.
template <class V, int kTerms, bool kProduct>
HWY_INLINE void weighMoments(const V* density, V* ioMoments)
{
    if constexpr (kProduct)
        for (int k = 0; k < kTerms; ++k) {
            V sum = density[0] * ioMoments[k];
            for (int i = 1; i < kTerms; ++i)
                sum = sum + density[i] * ioMoments[k + i];
            ioMoments[k] = sum;
        }
}

/// @formula gauss-attenuation
/// Light of a part of the ray by Gauss-Legendre nodes with the exact optical depth.
///
/// symbol   unit     meaning
///   h       m        half the length of the part
///   x       m        ray parameter from the middle of the part
///   rho     1/m      extinction, a polynomial of degree 2 n
///   s       cd/m3    source, a polynomial of degree D: 2 n, or 4 n in the product model
///   T       1        optical depth from the eye to the middle of the part; e^-T multiplies the sum
///   xi, w   1        nodes and weights on [-1, 1]
/// @derivation
///   tau(x) = T + integral from 0 to x of rho, exactly, odd and even powers apart              (1)
///   I = integral of e^-tau s dx = h sum over j of w_j e^-tau(h xi_j) s(h xi_j)                (2)
///   With s = sum c_k x^k this is sum over k of c_k M_k, M_k = h sum over j of w_j e^-tau(h xi_j) (h xi_j)^k:
///   moments that serve all blobs and channels, formula blob-polynomial (5)                             (3)
///   Nodes come in pairs +-xi: M_k has e^-tau(x) + e^-tau(-x) for even k and their difference for odd k. (4)
/// @source    [AS64] 25.4.29 for the rule; [UBT96] takes the attenuation linear in (2)
/// @deviation the paper's closed form needs a linear exponent; here the exponent is exact and the rule has
/// the
///            error, which falls like the (2 K)th power of the part
/// @valid     needs parts with an optical depth of at most the cap, 1 for five nodes and 2 for eight:
/// without,
///            five nodes return 2.7 times the light of a furnace
/// @accuracy  furnace: 1e-3 for 5 nodes and cap 1, 2e-5 for 8 nodes and cap 2 (1e-4 in float)
/// @tests     tests/rendering/reference/integral/test_furnace.cpp
template <int kNodes, bool kIsThin, class V, int kTerms, int kMoments>
HWY_INLINE void gaussMoments(const GaussRule<typename Lanes<V>::Scalar>& rule,
                             const DepthPolynomial<V, kTerms>& depth, V half, V middle, V* moment)
{
    setAll(moment, Lanes<V>::all(0), std::make_index_sequence<kMoments>());
    if constexpr (kNodes % 2 == 1)
        moment[0] = Lanes<V>::all(rule.centerWeight);
    for (int pair = 0; pair < kNodes / 2; ++pair) {
        const V x = half * Lanes<V>::all(rule.node[pair]);
        const V xx = x * x;
        const V odd = depth.odd(x, xx); // (1), from the middle
        const V even = depth.even(xx);
        const V ahead = kIsThin ? expOfSmall(even + odd) : expOfMinus(even + odd);
        const V behind = kIsThin ? expOfSmall(even - odd) : expOfMinus(even - odd);
        const V sum = ahead + behind; // (4)
        const V difference = ahead - behind;
        for (int k = 0; k < kMoments; ++k)
            moment[k] = moment[k] + (k % 2 == 0 ? sum : difference) * Lanes<V>::all(rule.weight[pair][k]);
    }
    V power = half * expOfMinus(middle); // (3)
    for (int k = 0; k < kMoments; ++k) {
        moment[k] = moment[k] * power;
        power = power * half;
    }
}

/// Moments and optical depth of a whole interval of half length `half` about the expansion point.
template <int kNodes, class V, int kTerms, int kMoments>
HWY_INLINE void gaussWhole(const GaussRule<typename Lanes<V>::Scalar>& rule,
                           const DepthPolynomial<V, kTerms>& depth, V half, V halfDepth, V* ioDepth,
                           V* outMoments)
{
    using T = typename Lanes<V>::Scalar;
    const V before = *ioDepth;
    const V middle = larger(before + (halfDepth - depth.even(half * half)), before);
    // Both forms have the same bits where the interval is thin.
    if (anyLess(Lanes<V>::all(T(kSmallDepth) / T(2)), halfDepth))
        gaussMoments<kNodes, false, V, kTerms, kMoments>(rule, depth, half, middle, outMoments);
    else
        gaussMoments<kNodes, true, V, kTerms, kMoments>(rule, depth, half, middle, outMoments);
    *ioDepth = before + (halfDepth + halfDepth);
}

/// Adds to `moments` a node at x with weight w and optical depth `total` from the eye.
template <class V, int kMoments>
HWY_INLINE void addNode(V x, V weight, V total, V* moments)
{
    V power = weight * expOfMinus(total);
    for (int k = 0; k < kMoments; ++k) {
        moments[k] = moments[k] + power;
        power = power * x;
    }
}

/// @formula linear-attenuation
/// Light of a part of the ray with the optical depth taken linear within it, in closed form: the published
/// method.
///
/// symbol   unit     meaning
///   L       m        length of the part
///   u       1        place in the part, 0..1
///   c_k     cd/m3    coefficients of the source in powers of the length x from the part's beginning, x = L u
///   S       1        optical depth of the part, exact
///   T       1        optical depth before the part
///   m_k     1        moments of e^(-S u), formula attenuation-moments
/// @derivation
///   tau(u) = T + S u: right at both ends                                                 (1)
///   I = e^-T sum over k of c_k L^(k+1) m_k(S)                                            (2)
/// @source    [UBT96] eq. (3)
/// @deviation powers are those of the local length, moments are the stable ones
/// @valid     S >= 0; L = 0 gives 0
/// @accuracy  relative error S^2 / 42 for a thin blob that is one part, 0.018 at S = 1; a furnace of optical
/// depth 100 returns
///            0.6 % of its light
/// @tests     tests/rendering/reference/integral/test_schemes.cpp
template <class V, int kTerms, int kMoments>
HWY_INLINE void linearMoments(const V* density, V length, V* ioDepth, V* outMoments)
{
    const V own = larger(DepthPolynomial<V, kTerms>(density).at(length), Lanes<V>::all(0));
    attenuationMoments<V, kMoments - 1>(own, outMoments);
    V power = length * expOfMinus(*ioDepth);
    for (int k = 0; k < kMoments; ++k) { // (2)
        outMoments[k] = outMoments[k] * power;
        power = power * length;
    }
    *ioDepth = *ioDepth + own;
}

/// @formula depth-linear-source
/// Light between two places when the source per optical depth is linear in optical depth.
///
/// symbol   unit     meaning
///   D       1        optical depth between the places, >= 0
///   e0, e1  cd/m2    source per optical depth at the places
///   m_0, m_1  1      formula attenuation-moments with s = D
/// @derivation
///   I = integral from 0 to D of e^-t (e0 + (e1 - e0) t / D) dt = D (e0 (m_0 - m_1) + e1 m_1)     (1)
///   m_0 >= m_1 >= 0, and D m_0 = 1 - e^-D: I lies between the two sources times the opacity      (2)
/// @source    [MAX95] for a constant source per optical depth, whose light is the source times the opacity
/// @deviation linear in optical depth instead of constant
/// @valid     any D >= 0
/// @accuracy  never creates light beyond rounding; second order in the distance of the places
/// @tests     tests/rendering/reference/integral/test_schemes.cpp
template <class V>
HWY_INLINE void depthLinearPiece(V own, const V* from, const V* to, V before, Gathered<V>& io)
{
    V moment[2];
    attenuationMoments<V, 1>(own, moment);
    const V scale = own * before;
    const V far = scale * moment[1];
    const V near = larger(scale * moment[0] - far, Lanes<V>::all(0)); // (1)
    for (int channel = 0; channel < 3; ++channel)
        io.light[channel] = io.light[channel] + (from[channel] * near + to[channel] * far);
}
