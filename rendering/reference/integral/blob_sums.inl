// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces, before
// interval_walk.inl. Sums over the blobs that a place of the ray lies in.

/// @formula blob-polynomial
/// The kernel of one blob along a ray as a polynomial about a point of the present interval.
///
/// symbol   unit   meaning
///   H       m2     square of half the chord, R^2 - b^2
///   d       m      ray parameter of the expansion point minus that of the point nearest to the center
///   x       m      ray parameter minus that of the expansion point
///   g       m2     H - d^2
///   n       1      degree of the kernel
///   w       1/m    extinction (or extinction times source) at the center, divided by R^(2 n)
/// @derivation
///   R^2 (1 - q^2) = H - (d + x)^2 = g - 2 d x - x^2                                          (1)
///   n = 2:  (1)^2 = g^2 - 4 d g x + 2 (2 d^2 - g) x^2 + 4 d x^3 + x^4                        (2)
///   n = 3, 4: products of (2) with (1) and with itself                                        (3)
///   extinction is the sum over blobs of w times these coefficients q_k; the numbers 4 and 2 of (2)
///   multiply the sums                                                                          (4)
///   light in a channel is the sum over blobs of w times the blob's source times sum over k of q_k M_k, where
///   M_k is the integral of the attenuation times x^k, the same for all blobs and channels      (5)
///   for n = 2 that is g (M_0 g - 4 M_1 d - 2 M_2) + d (4 M_2 d + 4 M_3) + M_4                  (6)
///   A blob counts where g > 0 at the middle of the interval: no blob begins or ends within it.
/// @source    [UBT96] section on the integral along a ray, for the polynomial between sorted events
/// @deviation coefficients are built anew about a point of each interval; the paper's are about the
///            ray's origin
///            and are added at a blob's entry and subtracted at its exit, which loses every digit in float
/// @valid     any d; in lanes that lie outside of the blob every term is exactly 0
/// @accuracy  8 eps of the largest value in the interval for each blob; lanes equal scalars bit for bit
/// @tests     tests/rendering/reference/integral/test_ray_integrator.cpp
template <class V, int kDegree>
HWY_INLINE void kernelPolynomial(V d, V g, V* q)
{
    const V zero = d - d;
    const V b = zero - (d + d);
    const V square[5] = {g * g, (g + g) * b, b * b - (g + g), zero - (b + b),
                         zero};   // (2) but for the last, 1
    if constexpr (kDegree == 3) { // (3)
        q[0] = square[0] * g;
        q[1] = square[1] * g + square[0] * b;
        q[2] = square[2] * g + square[1] * b - square[0];
        q[3] = square[3] * g + square[2] * b - square[1];
        q[4] = g + square[3] * b - square[2];
        q[5] = b - square[3];
    } else {
        q[0] = square[0] * square[0];
        q[1] = (square[0] + square[0]) * square[1];
        q[2] = (square[0] + square[0]) * square[2] + square[1] * square[1];
        q[3] = (square[0] + square[0]) * square[3] + (square[1] + square[1]) * square[2];
        q[4] = (square[0] + square[0]) + (square[1] + square[1]) * square[3] + square[2] * square[2];
        q[5] = (square[1] + square[1]) + (square[2] + square[2]) * square[3];
        q[6] = (square[2] + square[2]) + square[3] * square[3];
        q[7] = square[3] + square[3];
    }
}

/// With places that are constants for the compiler, so that sums stay in registers.
template <class V, size_t... k>
HWY_INLINE void addWeighted(V* sum, V weight, const V* terms, std::index_sequence<k...>)
{
    ((sum[k] = sum[k] + weight * terms[k]), ...);
    sum[sizeof...(k)] = sum[sizeof...(k)] + weight; // the highest has 1
}
template <class V, size_t... k>
HWY_INLINE void setAll(V* to, V value, std::index_sequence<k...>)
{
    ((to[k] = value), ...);
}

template <class V, size_t... k>
HWY_INLINE void setFrom(V* to, const V* from, std::index_sequence<k...>)
{
    ((to[k] = from[k]), ...);
}

/// Extinction about `at` of the candidates that `inside`, a place within the interval, lies in. Leaves them
/// in `nearby` for addLight(), with numbers that both need.
/// @param length lanes with 0 are not counted as work
/// @tparam kCentered `at` is `inside`
template <class V, int kDegree, bool kCentered>
HWY_INLINE void sumExtinction(const BlobLanes<typename Lanes<V>::Scalar>& blobs, V inside, V at, V length,
                              const NearbyBlobs<typename Lanes<V>::Scalar>& nearby, RayWork* work,
                              V* outDensity)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    constexpr int kTop = 2 * kDegree;
    const V zero = Lanes<V>::all(0);
    V sum[kTop + 1];
    setAll(sum, zero, std::make_index_sequence<kTop + 1>());
    V squares = zero;       // of w g, a part of sum[2]
    const auto own = blobs; // copies: stores below cannot change them
    const auto out = nearby;
    uint32_t count = 0;
    for (uint32_t word = 0; word < own.words; ++word)
        for (uint64_t bits = own.candidates[word]; bits != 0; bits &= bits - 1) {
            const size_t blob = size_t(word) * 64 + size_t(std::countr_zero(bits));
            const V center = Lanes<V>::load(own.center + blob * kWidth);
            const V chord2 = Lanes<V>::load(own.chord2 + blob * kWidth);
            const V d = at - center;
            const V dd = d * d;
            const V g = chord2 - dd;
            V margin = g;
            if constexpr (!kCentered)
                margin = chord2 - (inside - center) * (inside - center);
            Lanes<V>::store(out.offset + size_t(count) * kWidth, d);
            Lanes<V>::store(out.square + size_t(count) * kWidth, g);
            if constexpr (!kCentered)
                Lanes<V>::store(out.margin + size_t(count) * kWidth, margin);
            out.blob[count] = uint32_t(blob);
            count += anyLess(zero, margin) ? 1 : 0;
            const V weight = chooseLess(zero, margin, Lanes<V>::all(own.weights[blob * 4]), zero);
            if constexpr (kDegree == 2) {
                const V wg = weight * g, wd = weight * d;
                sum[0] = sum[0] + wg * g;
                sum[1] = sum[1] + wg * d;
                sum[2] = sum[2] + wd * d;
                squares = squares + wg;
                sum[3] = sum[3] + wd;
                sum[4] = sum[4] + weight;
            } else {
                V q[kTop];
                // Far outside of the blob the powers leave the range of a float.
                kernelPolynomial<V, kDegree>(chooseLess(zero, margin, d, zero),
                                             chooseLess(zero, margin, g, zero), q);
                addWeighted(sum, weight, q, std::make_index_sequence<kTop>());
            }
            if (work)
                work->blobSums += countLess(zero, chooseLess(zero, length, margin, zero));
        }
    *out.count = count;
    if constexpr (kDegree == 2) { // (4)
        sum[1] = sum[1] * Lanes<V>::all(-4);
        sum[2] = (sum[2] + sum[2]) - squares;
        sum[2] = sum[2] + sum[2];
        sum[3] = sum[3] * Lanes<V>::all(4);
    }
    if constexpr (kDegree == 3)
        sum[6] = zero - sum[6];
    for (int k = 0; k <= kTop; ++k)
        outDensity[k] = sum[k];
}

/// (5): adds to each channel of `light` the integral of attenuation times source of the blobs that
/// sumExtinction() has left in `nearby`. @param moments M_k for k = 0 to 2 kDegree
template <class V, int kDegree, bool kCentered>
HWY_INLINE void addLight(const NearbyBlobs<typename Lanes<V>::Scalar>& nearby,
                         const typename Lanes<V>::Scalar* blobWeights, const V* moments, V* light)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    const V zero = Lanes<V>::all(0);
    V sum[3] = {zero, zero, zero}; // apart from what the ray has already, which would swallow small shares
    const V m0 = moments[0];
    const V m1 = moments[1] * Lanes<V>::all(-4);
    const V m2 = moments[2] + moments[2];
    const V m22 = m2 + m2;
    const V m3 = moments[3] * Lanes<V>::all(4);
    const auto own = nearby;
    const uint32_t count = *own.count;
    for (uint32_t i = 0; i < count; ++i) {
        const V d = Lanes<V>::load(own.offset + size_t(i) * kWidth);
        const V g = Lanes<V>::load(own.square + size_t(i) * kWidth);
        const V margin = kCentered ? g : Lanes<V>::load(own.margin + size_t(i) * kWidth);
        V share;
        if constexpr (kDegree == 2) {
            share = g * ((m0 * g + m1 * d) - m2) + d * (m22 * d + m3) + moments[4]; // (6)
        } else {
            V q[2 * kDegree];
            kernelPolynomial<V, kDegree>(d, g, q);
            share = kDegree == 3 ? zero - moments[2 * kDegree] : moments[2 * kDegree];
            for (int k = 0; k < 2 * kDegree; ++k)
                share = share + q[k] * moments[k];
        }
        share = chooseLess(zero, margin, share, zero);
        const auto* weights = blobWeights + size_t(own.blob[i]) * 4;
        sum[0] = sum[0] + share * Lanes<V>::all(weights[1]);
        sum[1] = sum[1] + share * Lanes<V>::all(weights[2]);
        sum[2] = sum[2] + share * Lanes<V>::all(weights[3]);
    }
    for (int c = 0; c < 3; ++c)
        light[c] = light[c] + sum[c];
}

/// Adds the extinction and the sources of one blob at a place where its H - d^2 is `g`, >= 0.
template <class V, int kDegree>
HWY_INLINE void addKernel(const typename Lanes<V>::Scalar* weights, V g, V* sums)
{
    V kernel = g;
    for (int k = 1; k < kDegree; ++k)
        kernel = kernel * g;
    for (int c = 0; c < 4; ++c)
        sums[c] = sums[c] + kernel * Lanes<V>::all(weights[c]);
}

/// Extinction and sources at a place from all candidates, every term >= 0.
template <class V, int kDegree>
HWY_NOINLINE void sumKernels(const BlobLanes<typename Lanes<V>::Scalar>& blobs, V at, RayWork* work,
                             V* outSums)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    const V zero = Lanes<V>::all(0);
    V sums[4] = {zero, zero, zero, zero};
    for (uint32_t word = 0; word < blobs.words; ++word)
        for (uint64_t bits = blobs.candidates[word]; bits != 0; bits &= bits - 1) {
            const size_t blob = size_t(word) * 64 + size_t(std::countr_zero(bits));
            const V d = at - Lanes<V>::load(blobs.center + blob * kWidth);
            const V g = larger(zero, Lanes<V>::load(blobs.chord2 + blob * kWidth) - d * d);
            addKernel<V, kDegree>(blobs.weights + blob * 4, g, sums);
            if (work)
                work->blobSums += countLess(zero, g);
        }
    setFrom(outSums, sums, std::make_index_sequence<4>());
}

/// The same from the blobs that sumExtinction() has left in `nearby`: at the ends of an interval rounding
/// cannot let in others, whose sources would count where nothing else is.
template <class V, int kDegree>
HWY_NOINLINE void sumNearby(const BlobLanes<typename Lanes<V>::Scalar>& blobs,
                            const NearbyBlobs<typename Lanes<V>::Scalar>& nearby, V at, RayWork* work,
                            V* outSums)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    const V zero = Lanes<V>::all(0);
    V sums[4] = {zero, zero, zero, zero};
    for (uint32_t i = 0; i < *nearby.count; ++i) {
        const size_t blob = nearby.blob[i];
        const V d = at - Lanes<V>::load(blobs.center + blob * kWidth);
        const V g = larger(zero, Lanes<V>::load(blobs.chord2 + blob * kWidth) - d * d);
        const V own = chooseLess(zero, Lanes<V>::load(nearby.margin + size_t(i) * kWidth), g, zero);
        addKernel<V, kDegree>(blobs.weights + blob * 4, own, sums);
        if (work)
            work->blobSums += countLess(zero, own);
    }
    setFrom(outSums, sums, std::make_index_sequence<4>());
}
