// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces, after
// part_rules.inl. How each scheme treats an interval between events. Each has interval(begin, length),
// isDone() and finish().

/// What all rules share.
template <class V, int kDegree, bool kProduct>
struct RuleBase
{
    using T = typename Lanes<V>::Scalar;
    static constexpr int kTerms = 2 * kDegree + 1;
    static constexpr int kMoments = kMomentCount<kTerms, kProduct>;
    using Walk = IntervalWalk<V, kDegree, kProduct>;

    Walk& walk;
    const GroupRules<T>& rules;
    Gathered<V>& io;
    BlobLanes<T> blobs;
    RayWork* work;

    RuleBase(Walk& from, const GroupRules<T>& own, Gathered<V>& gathered)
        : walk(from), rules(own), io(gathered), blobs(from.blobs()), work(from.work())
    {}
    void finish() {}
    bool isDone() const { return !anyLess(io.depth, Lanes<V>::all(rules.stopDepth)); }
    /// The length in lanes that still go on, 0 in others.
    HWY_INLINE V open(V length) const
    {
        return chooseLess(io.depth, Lanes<V>::all(rules.stopDepth), length, Lanes<V>::all(0));
    }
    /// Extinction about `at`, for the interval around `inside`.
    template <bool kCentered>
    HWY_NOINLINE void sum(V inside, V at, V length, V* outDensity) const
    {
        sumExtinction<V, kDegree, kCentered>(blobs, inside, at, length, blobs.nearby[0], work, outDensity);
    }
    /// Light from moments about the `at` of sum().
    template <bool kCentered>
    HWY_NOINLINE void shine(const V* density, V* moments)
    {
        weighMoments<V, kTerms, kProduct>(density, moments);
        addLight<V, kDegree, kCentered>(blobs.nearby[0], blobs.weights, moments, io.light);
    }
    void count(V length, uint32_t parts, uint32_t nodes, uint32_t exponentials)
    {
        if (!work)
            return;
        const uint32_t lanes = countLess(Lanes<V>::all(0), length);
        work->parts += uint64_t(lanes) * parts;
        work->nodes += uint64_t(lanes) * nodes * parts;
        work->exponentials += uint64_t(lanes) * exponentials * parts;
    }
};

/// Pieces between `nodes` (from -1 to 1) of each of `parts` equal parts; sources from sums of kernels.
template <class V, int kDegree, bool kProduct>
struct PositiveRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using typename Base::T;
    uint32_t parts = 1;

    PositiveRule(typename Base::Walk& from, const GroupRules<T>& own, Gathered<V>& gathered,
                 uint32_t partCount)
        : Base(from, own, gathered), parts(partCount)
    {}

    /// Source per optical depth; has no value where there is no medium.
    struct Place
    {
        V source[3];
        V extinction;
    };
    HWY_INLINE Place placeAt(V at) const
    {
        V sums[4];
        sumNearby<V, kDegree>(this->blobs, this->blobs.nearby[0], at, this->work, sums);
        Place place;
        place.extinction = sums[0];
        const V zero = Lanes<V>::all(0);
        const V tiny = Lanes<V>::all(std::numeric_limits<float>::min());
        for (int c = 0; c < 3; ++c)
            place.source[c] = kProduct ? sums[c + 1] : chooseLess(tiny, sums[0], sums[c + 1] / sums[0], zero);
        return place;
    }
    /// Gives each of two neighbors the source of the other where it has none.
    static HWY_INLINE void complete(Place& a, Place& b)
    {
        if constexpr (!kProduct) {
            const V tiny = Lanes<V>::all(std::numeric_limits<float>::min());
            for (int c = 0; c < 3; ++c) {
                a.source[c] = chooseLess(tiny, a.extinction, a.source[c], b.source[c]);
                b.source[c] = chooseLess(tiny, b.extinction, b.source[c], a.source[c]);
            }
        }
    }

    void interval(V begin, V length)
    {
        length = this->open(length);
        const V half = length * Lanes<V>::all(T(0.5));
        V density[Base::kTerms];
        this->template sum<false>(begin + half, begin, length, density);
        const DepthPolynomial<V, Base::kTerms> depth(density);
        const std::vector<T>& nodes = this->rules.positive;
        const uint32_t pieces = uint32_t(nodes.size()) - 1;
        const V partHalf = half * Lanes<V>::all(T(1) / T(parts));
        const V entry = this->io.depth;
        Place from = placeAt(begin);
        V done = Lanes<V>::all(0); // optical depth since `begin`
        for (uint32_t part = 0; part < parts; ++part) {
            const V middle = partHalf * Lanes<V>::all(T(2 * part + 1));
            const V seen = entry + done; // lanes end one by one, and keep what they have
            for (uint32_t i = 1; i <= pieces; ++i) {
                const V x = middle + partHalf * Lanes<V>::all(nodes[i]);
                Place to = placeAt(begin + x);
                complete(from, to);
                const V reached =
                    chooseLess(seen, Lanes<V>::all(this->rules.stopDepth), larger(done, depth.at(x)), done);
                depthLinearPiece<V>(reached - done, from.source, to.source, expOfMinus(entry + done),
                                    this->io);
                done = reached;
                from = to;
            }
            if (!anyLess(entry + done, Lanes<V>::all(this->rules.stopDepth)))
                break;
        }
        this->count(length, parts, pieces, 2 * pieces);
        this->io.depth = entry + done;
    }
};

template <int kNodes, class V, int kDegree, bool kProduct>
struct GaussIntervalRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using typename Base::T;
    static constexpr uint32_t kMaxParts = 64;
    const GaussRule<T>& nodes;
    V waiting[Base::kTerms]; ///< moments of the interval before
    bool isWaiting = false;
    uint32_t turn = 0;

    GaussIntervalRule(typename Base::Walk& from, const GroupRules<T>& own, Gathered<V>& gathered)
        : Base(from, own, gathered), nodes(kNodes == 3   ? own.gauss3
                                           : kNodes == 5 ? own.gauss5
                                                         : own.gauss8)
    {}

    HWY_INLINE void interval(V begin, V length)
    {
        const V whole = length * Lanes<V>::all(T(0.5));
        const V middle = begin + whole; // of closed lanes as well, so that sums need not wait for their depth
        V density[Base::kTerms];
        const NearbyBlobs<T>& nearby = this->blobs.nearby[turn];
        sumExtinction<V, kDegree, true>(this->blobs, middle, middle, length, nearby, this->work, density);
        const V half = this->open(whole);
        const DepthPolynomial<V, Base::kTerms> depth(density);
        const V halfDepth = larger(depth.odd(half, half * half), Lanes<V>::all(0));
        V moments[Base::kMoments];
        if (anyLess(Lanes<V>::all(this->rules.caps[kDegree - 2]), halfDepth + halfDepth)) {
            split(depth, begin, middle, half, halfDepth, moments);
        } else {
            gaussWhole<kNodes, V, Base::kTerms, Base::kMoments>(nodes, depth, half, halfDepth,
                                                                &this->io.depth, moments);
            this->count(half, 1, kNodes, kNodes);
        }
        weighMoments<V, Base::kTerms, kProduct>(density, moments);
        // Light is one interval late: its sums fill the time in which the next interval waits for
        // exponentials.
        finish();
        setFrom(waiting, moments, std::make_index_sequence<size_t(Base::kTerms)>());
        isWaiting = true;
        turn = 1 - turn;
    }

    HWY_INLINE void finish()
    {
        if (isWaiting)
            addLight<V, kDegree, true>(this->blobs.nearby[1 - turn], this->blobs.weights, waiting,
                                       this->io.light);
        isWaiting = false;
    }

    /// Lanes within the cap as a whole, others in equal parts of at most the cap on average, and as
    /// PositiveRule where 64 do not suffice. Moments are about the middle of the interval for all parts
    /// together.
    HWY_NOINLINE void split(const DepthPolynomial<V, Base::kTerms>& depth, V begin, V middle, V half,
                            V halfDepth, V* moments)
    {
        const V zero = Lanes<V>::all(0);
        const V one = Lanes<V>::all(1);
        const V most = Lanes<V>::all(T(kMaxParts));
        const V entry = this->io.depth;
        const V wanted =
            smaller((halfDepth + halfDepth) / Lanes<V>::all(this->rules.caps[kDegree - 2]), most + most);
        const V parts = larger(wholeAbove(wanted), one);

        const V thin = chooseLess(one, parts, zero, half);
        V thinMoments[Base::kMoments];
        gaussWhole<kNodes, V, Base::kTerms, Base::kMoments>(
            nodes, depth, thin, chooseLess(one, parts, zero, halfDepth), &this->io.depth, thinMoments);
        this->count(thin, 1, kNodes, kNodes);

        for (int k = 0; k < Base::kMoments; ++k)
            moments[k] = zero;
        const V thick = chooseLess(one, parts, chooseLess(most, parts, zero, half), zero);
        if (anyLess(zero, thick))
            addParts(depth, thick, parts, entry, moments);
        const V beyond = chooseLess(most, parts, half, zero);
        for (int k = 0; k < Base::kMoments; ++k)
            moments[k] = chooseLess(one, parts, moments[k], thinMoments[k]);
        this->io.depth = chooseLess(zero, thick, entry + (halfDepth + halfDepth), this->io.depth);
        if (anyLess(zero, beyond))
            fallBack(begin, beyond, middle);
    }

    HWY_INLINE void addParts(const DepthPolynomial<V, Base::kTerms>& depth, V half, V parts, V entry,
                             V* moments)
    {
        const V zero = Lanes<V>::all(0);
        const V start = larger(zero, depth.odd(half, half * half)) - depth.even(half * half);
        const V partHalf = half / parts;
        const uint32_t last = uint32_t(highest(chooseLess(zero, half, parts, zero)));
        for (uint32_t part = 0; part < last; ++part) {
            const V isOpen = chooseLess(Lanes<V>::all(T(part)), parts, partHalf, zero);
            const V center = partHalf * Lanes<V>::all(T(2 * part + 1)) - half;
            for (int node = 0; node < kNodes; ++node) {
                const int pair = node < kNodes / 2 ? node : kNodes - 1 - node;
                const bool isCenter = kNodes % 2 == 1 && node == kNodes / 2;
                const T place = isCenter            ? T(0)
                                : node < kNodes / 2 ? T(0) - nodes.node[pair]
                                                    : nodes.node[pair];
                const T weight = isCenter ? nodes.centerWeight : nodes.weight[pair][0];
                const V x = chooseLess(zero, isOpen, center + partHalf * Lanes<V>::all(place), zero);
                const V total = entry + larger(zero, start + depth.at(x));
                addNode<V, Base::kMoments>(x, isOpen * Lanes<V>::all(weight), total, moments);
            }
            this->count(isOpen, 1, kNodes, kNodes);
        }
    }

    /// The other lanes need the sums about the middle again afterwards.
    HWY_NOINLINE void fallBack(V begin, V half, V middle)
    {
        finish(); // light is added in the order of intervals, whatever other lanes do
        this->io.fallback = chooseLess(Lanes<V>::all(0), half, Lanes<V>::all(1), this->io.fallback);
        PositiveRule<V, kDegree, kProduct> positive(this->walk, this->rules, this->io, kMaxParts);
        positive.interval(begin, half + half);
        V density[Base::kTerms];
        sumExtinction<V, kDegree, true>(this->blobs, middle, middle, half, this->blobs.nearby[turn], nullptr,
                                        density);
    }
};

/// Linear attenuation in equal parts, each with polynomials of its own about its beginning.
template <class V, int kDegree, bool kProduct>
struct LinearRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using Base::Base;
    using typename Base::T;

    HWY_INLINE void interval(V begin, V length)
    {
        const uint32_t parts = this->rules.settings.scheme.count;
        inParts(begin, this->open(length), parts, Lanes<V>::all(T(parts)));
    }
    /// @param parts in each lane, at most `most`
    HWY_INLINE void inParts(V begin, V length, uint32_t most, V parts)
    {
        const V own = length / parts;
        for (uint32_t part = 0; part < most; ++part) {
            const V place = Lanes<V>::all(T(part));
            const V start = begin + own * place;
            const V step = chooseLess(place, parts, own, Lanes<V>::all(0));
            V density[Base::kTerms];
            this->template sum<false>(start + own * Lanes<V>::all(T(0.5)), start, step, density);
            V moments[Base::kMoments];
            linearMoments<V, Base::kTerms, Base::kMoments>(density, step, &this->io.depth, moments);
            this->template shine<false>(density, moments);
            this->count(step, 1, 0, 2);
        }
    }
};

/// Simpson's rule with exact optical depth on equal panels.
template <class V, int kDegree, bool kProduct>
struct SimpsonRule : RuleBase<V, kDegree, kProduct>
{
    using Base = RuleBase<V, kDegree, kProduct>;
    using Base::Base;
    using typename Base::T;

    HWY_INLINE void interval(V begin, V length)
    {
        const V zero = Lanes<V>::all(0);
        const V half = this->open(length) * Lanes<V>::all(T(0.5));
        const V middle = begin + half;
        V density[Base::kTerms];
        this->template sum<true>(middle, middle, half, density);
        const DepthPolynomial<V, Base::kTerms> depth(density);
        const V halfDepth = larger(depth.odd(half, half * half), zero);
        const V start = halfDepth - depth.even(half * half);
        V moments[Base::kMoments];
        for (int k = 0; k < Base::kMoments; ++k)
            moments[k] = zero;
        const uint32_t last = 2 * this->rules.settings.scheme.count;
        for (uint32_t node = 0; node <= last; ++node) {
            const T place = T(2) * T(node) / T(last) - T(1);
            const T weight = (node == 0 || node == last ? T(1)
                              : node % 2 == 1           ? T(4)
                                                        : T(2)) *
                             T(2) / (T(3) * T(last));
            const V x = half * Lanes<V>::all(place);
            addNode<V, Base::kMoments>(x, half * Lanes<V>::all(weight),
                                       this->io.depth + larger(zero, start + depth.at(x)), moments);
        }
        this->io.depth = this->io.depth + (halfDepth + halfDepth);
        this->template shine<true>(density, moments);
        this->count(half, last / 2, 2, 2);
    }
};
