// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces, after
// interval_rules.inl. Schemes that need the whole ray, and the choice of scheme.

/// Equal steps from the first event to the last.
template <class V, int kDegree, bool kProduct>
void marchRay(IntervalWalk<V, kDegree, kProduct>& walk, const GroupRules<typename Lanes<V>::Scalar>& rules,
              Gathered<V>& io)
{
    using T = typename Lanes<V>::Scalar;
    constexpr uint32_t kMaxSteps = 1u << 20;
    const RuleBase<V, kDegree, kProduct> base(walk, rules, io);
    RayWork* work = walk.work();
    const V zero = Lanes<V>::all(0);
    const V first = walk.firstEvent(), last = walk.lastEvent();
    const V step = larger(Lanes<V>::all(static_cast<T>(rules.settings.scheme.step) * walk.scale()),
                          (last - first) * Lanes<V>::all(T(1) / T(kMaxSteps)));
    V transmittance = Lanes<V>::all(1);
    walk.rewind();
    for (uint32_t i = 0; i < kMaxSteps && !base.isDone(); ++i) {
        const V at = first + step * Lanes<V>::all(T(i) + T(0.5));
        if (!anyLess(at, last))
            break;
        const V own = base.open(chooseLess(at, last, step, zero));
        // A little beyond, so that rounding at its ends does not make a blob depend on the lanes beside.
        const T pad =
            T(16) * std::numeric_limits<T>::epsilon() * (T(2) + std::max(highest(at), T(0) - lowest(at)));
        walk.moveTo(lowest(at) - pad, highest(at) + pad);
        V sums[4];
        sumKernels<V, kDegree>(walk.blobs(), at, work, sums);
        const V depth = sums[0] * own;
        const V passed = expOfMinus(depth);
        const V opacity = transmittance * (Lanes<V>::all(1) - passed);
        const V share = kProduct ? opacity : chooseLess(zero, depth, opacity / sums[0], zero);
        for (int c = 0; c < 3; ++c)
            io.light[c] = io.light[c] + share * sums[c + 1];
        transmittance = transmittance * passed;
        io.depth = io.depth + depth;
        if (work) {
            work->parts += countLess(zero, own);
            work->nodes += countLess(zero, own);
            work->exponentials += countLess(zero, own);
        }
    }
}

/// @formula light-from-behind
/// A bound on the light that the rest of a ray can still bring, and what follows for its splitting.
///
/// symbol     unit     meaning
///   S_k       cd/m2    light of interval k without attenuation within it, largest channel, exact
///   tau_k     1        optical depth of interval k, exact
///   F_k       cd/m2    bound on the light that enters interval k's front side from itself and all behind
///   T         1        transmittance from the eye to interval k
///   d_k       1        largest distance of the optical depth within interval k from a straight line
///   n         1        number of intervals
///   e         1        tolerance
/// @derivation
///   F_k = S_k + e^-tau_k F_{k+1}, F_n is the background                                 (1)
///   attenuation is at most 1 and |e^-a - e^-b| <= |a - b| for a, b >= 0, so that linear attenuation errs in
///   interval k by at most T S_k d_k; with m equal parts d_k falls by m^2                (2)
///   m = ceil(sqrt(T S_k d_k n / (e F_0))) keeps the sum of all errors below e F_0       (3)
///   the ray ends where T F_k < e F_0: transmittance alone does not tell, since much light may come from
///   behind  (4)
/// @source    [UBT96] section on adaptive splitting, for (1), (2) and (4)
/// @deviation (3) chooses the number of parts at once instead of splitting again and again; d_k is 1.25 times
/// its
///            largest value at 1/4, 1/2 and 3/4 of the interval
/// @valid     at most 64 parts
/// @accuracy  error <= 2 e F_0 while 64 parts suffice
/// @tests     tests/rendering/reference/integral/test_schemes.cpp
template <class V, int kDegree, bool kProduct>
struct BoundRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using typename Base::T;
    static constexpr uint32_t kNumbers = 3; ///< S, tau, d; F replaces S in the end
    T* store;
    uint32_t count_ = 0;
    V intervals; ///< of positive length, which differ from lane to lane

    BoundRule(typename Base::Walk& from, const GroupRules<T>& own, Gathered<V>& gathered, T* room)
        : Base(from, own, gathered), store(room), intervals(Lanes<V>::all(0))
    {}
    T* place(uint32_t k, uint32_t number) const
    {
        return store + size_t(k * kNumbers + number) * Lanes<V>::kWidth;
    }
    bool isDone() const { return false; }

    void interval(V begin, V length)
    {
        V density[Base::kTerms];
        this->template sum<false>(begin + length * Lanes<V>::all(T(0.5)), begin, length, density);
        const DepthPolynomial<V, Base::kTerms> depth(density);
        const V zero = Lanes<V>::all(0);
        const V own = larger(depth.at(length), zero);
        V moments[Base::kMoments]; // of an attenuation of 1
        V power = length;
        for (int k = 0; k < Base::kMoments; ++k, power = power * length)
            moments[k] = power * Lanes<V>::all(T(1) / T(k + 1));
        weighMoments<V, Base::kTerms, kProduct>(density, moments);
        V sums[3] = {zero, zero, zero};
        addLight<V, kDegree, false>(this->blobs.nearby[0], this->blobs.weights, moments, sums);
        const V light = larger(larger(larger(sums[0], sums[1]), sums[2]), zero);
        V bend = zero;
        for (int i = 1; i < 4; ++i) {
            const V u = Lanes<V>::all(T(i) * T(0.25));
            const V off = depth.at(length * u) - own * u;
            bend = larger(bend, larger(off, zero - off));
        }
        Lanes<V>::store(place(count_, 0), light);
        Lanes<V>::store(place(count_, 1), own);
        Lanes<V>::store(place(count_, 2), bend * Lanes<V>::all(T(1.25)));
        ++count_;
        intervals = intervals + chooseLess(zero, length, Lanes<V>::all(1), zero);
    }
    /// (1), from the back. @return F_0
    V fromBehind(V background)
    {
        V bound = background;
        for (uint32_t k = count_; k > 0; --k) {
            bound = Lanes<V>::load(place(k - 1, 0)) + expOfMinus(Lanes<V>::load(place(k - 1, 1))) * bound;
            // S is still needed: F goes to the place of tau
            Lanes<V>::store(place(k - 1, 1), bound);
        }
        return bound;
    }
};

template <class V, int kDegree, bool kProduct>
struct AdaptiveRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using typename Base::T;
    static constexpr uint32_t kMaxParts = 64;
    const BoundRule<V, kDegree, kProduct>& bounds;
    LinearRule<V, kDegree, kProduct> parts;
    V allowed; ///< e F_0
    V isOpen;
    uint32_t next = 0;

    AdaptiveRule(typename Base::Walk& from, const GroupRules<T>& own, Gathered<V>& gathered,
                 const BoundRule<V, kDegree, kProduct>& found, V most)
        : Base(from, own, gathered), bounds(found), parts(from, own, gathered),
          allowed(most * Lanes<V>::all(static_cast<T>(own.settings.scheme.tolerance))),
          isOpen(Lanes<V>::all(1))
    {}
    bool isDone() const { return !anyLess(Lanes<V>::all(0), isOpen) || Base::isDone(); }

    void interval(V begin, V length)
    {
        const V zero = Lanes<V>::all(0);
        const V passed = expOfMinus(this->io.depth);
        const V light = Lanes<V>::load(bounds.place(next, 0));
        const V rest = Lanes<V>::load(bounds.place(next, 1));
        const V bend = Lanes<V>::load(bounds.place(next, 2));
        ++next;
        isOpen = chooseLess(passed * rest, allowed, zero, isOpen); // (4)
        const V own = chooseLess(zero, isOpen, this->open(length), zero);
        const V share = allowed / larger(bounds.intervals, Lanes<V>::all(1));
        const V wanted = root(passed * light * bend / larger(share, Lanes<V>::all(T(1e-37f))));
        const V most = Lanes<V>::all(T(kMaxParts));
        // Where a product above is out of range, `wanted` may be no number: as many parts as there can be.
        const V number = larger(wholeAbove(chooseLess(wanted, most, wanted, most)), Lanes<V>::all(1)); // (3)
        const V used = chooseLess(zero, own, number, Lanes<V>::all(1));
        parts.inParts(begin, own, uint32_t(highest(used)), used);
    }
};

template <class V, int kDegree, bool kProduct>
void adaptRay(IntervalWalk<V, kDegree, kProduct>& walk, const GroupRules<typename Lanes<V>::Scalar>& rules,
              GroupScratch<typename Lanes<V>::Scalar>& scratch, V background, Gathered<V>& io)
{
    using Bounds = BoundRule<V, kDegree, kProduct>;
    Bounds bounds(walk, rules, io,
                  scratch.perInterval.room(size_t(walk.events()) * Bounds::kNumbers * Lanes<V>::kWidth));
    walk.forEachInterval(bounds);
    const V most = bounds.fromBehind(background);
    AdaptiveRule<V, kDegree, kProduct> rule(walk, rules, io, bounds, most);
    walk.forEachInterval(rule);
}

template <class Walk, class Rule>
void walkWith(Walk& walk, Rule rule)
{
    walk.forEachInterval(rule);
}

template <class V, int kDegree, bool kProduct>
void runScheme(IntervalWalk<V, kDegree, kProduct>& walk, const GroupRules<typename Lanes<V>::Scalar>& rules,
               GroupScratch<typename Lanes<V>::Scalar>& scratch, V background, Gathered<V>& io)
{
    switch (rules.settings.scheme.method) {
    case IntegralMethod::Paper:
        return walkWith(walk, LinearRule<V, kDegree, kProduct>(walk, rules, io));
    case IntegralMethod::Simpson:
        return walkWith(walk, SimpsonRule<V, kDegree, kProduct>(walk, rules, io));
    case IntegralMethod::Positive:
        return walkWith(walk, PositiveRule<V, kDegree, kProduct>(walk, rules, io, 1));
    case IntegralMethod::March:
        return marchRay<V, kDegree, kProduct>(walk, rules, io);
    case IntegralMethod::Adaptive:
        return adaptRay<V, kDegree, kProduct>(walk, rules, scratch, background, io);
    case IntegralMethod::Gauss:
        break;
    }
    if (rules.settings.scheme.count == 3)
        walkWith(walk, GaussIntervalRule<3, V, kDegree, kProduct>(walk, rules, io));
    else if (rules.settings.scheme.count == 8)
        walkWith(walk, GaussIntervalRule<8, V, kDegree, kProduct>(walk, rules, io));
    else
        walkWith(walk, GaussIntervalRule<5, V, kDegree, kProduct>(walk, rules, io));
}

/// Everything for one group of rays.
template <class V, int kDegree, bool kProduct, class Shared>
void integrateGroup(const GroupRules<typename Lanes<V>::Scalar>& rules,
                    GroupScratch<typename Lanes<V>::Scalar>& scratch,
                    const GroupInput<typename Lanes<V>::Scalar>& input, const Shared* shared, RayWork* work,
                    const GroupOutput<typename Lanes<V>::Scalar>& out)
{
    using T = typename Lanes<V>::Scalar;
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    const V zero = Lanes<V>::all(0);
    Gathered<V> io;
    io.clear();
    V missing = zero;
    T lightUnit = T(1);
    V background[3];
    for (int c = 0; c < 3; ++c)
        background[c] = Lanes<V>::load(input.background[c]);
    if (work)
        work->rays += kWidth;
    if (input.count > 0) {
        IntervalWalk<V, kDegree, kProduct> walk(scratch, work);
        missing = walk.begin(input, shared);
        lightUnit = walk.lightUnit();
        const V brightest = larger(larger(background[0], background[1]), background[2]);
        runScheme<V, kDegree, kProduct>(walk, rules, scratch, brightest * Lanes<V>::all(T(1) / lightUnit),
                                        io);
    }
    const V transmittance = expOfMinus(io.depth);
    for (int c = 0; c < 3; ++c)
        Lanes<V>::store(out.radiance[c],
                        larger(io.light[c], zero) * Lanes<V>::all(lightUnit) + transmittance * background[c]);
    Lanes<V>::store(out.opticalDepth, io.depth);
    Lanes<V>::store(out.transmittance, transmittance);
    T fallback[kWidth], left[kWidth];
    Lanes<V>::store(fallback, io.fallback);
    Lanes<V>::store(left, missing);
    for (uint32_t lane = 0; lane < kWidth; ++lane)
        out.flags[lane] = (left[lane] > T(0) ? kRayTooSmall : 0u) |
                          (fallback[lane] > T(0) ? kRayFallback : 0u) |
                          (out.opticalDepth[lane] < rules.stopDepth ? 0u : kRayStopped);
}

/// Chooses the instantiation.
template <class V, class Shared>
void integrateAny(const GroupRules<typename Lanes<V>::Scalar>& rules,
                  GroupScratch<typename Lanes<V>::Scalar>& scratch,
                  const GroupInput<typename Lanes<V>::Scalar>& input, const Shared* shared, RayWork* work,
                  const GroupOutput<typename Lanes<V>::Scalar>& out)
{
    const uint32_t degree = rules.settings.degree;
    if (rules.settings.model == SourceModel::Product) {
        if (degree == 2)
            integrateGroup<V, 2, true>(rules, scratch, input, shared, work, out);
        else if (degree == 3)
            integrateGroup<V, 3, true>(rules, scratch, input, shared, work, out);
        else
            integrateGroup<V, 4, true>(rules, scratch, input, shared, work, out);
    } else {
        if (degree == 2)
            integrateGroup<V, 2, false>(rules, scratch, input, shared, work, out);
        else if (degree == 3)
            integrateGroup<V, 3, false>(rules, scratch, input, shared, work, out);
        else
            integrateGroup<V, 4, false>(rules, scratch, input, shared, work, out);
    }
}
