// Included by ray_integrator-inl.h and packet_integral.cpp inside of their namespaces.
// From the blobs of a group of rays to the intervals between sorted entries and exits.

constexpr uint32_t kSortBlock = 8; ///< rows that are sorted in registers

template <class V>
HWY_INLINE void order(V& ioLow, V& ioHigh)
{
    const V low = minOf(ioLow, ioHigh);
    ioHigh = maxOf(ioLow, ioHigh);
    ioLow = low;
}

/// The last steps of a merge, within one block.
template <class V>
HWY_INLINE void mergeBlock(V* row)
{
    for (uint32_t i = 0; i < 4; ++i)
        order(row[i], row[i + 4]);
    for (uint32_t i = 0; i < 8; i += 4) {
        order(row[i], row[i + 2]);
        order(row[i + 1], row[i + 3]);
    }
    for (uint32_t i = 0; i < 8; i += 2)
        order(row[i], row[i + 1]);
}

template <class V>
HWY_INLINE void sortBlock(V* row)
{
    for (uint32_t i = 0; i < 8; i += 2)
        order(row[i], row[i + 1]);
    for (uint32_t i = 0; i < 8; i += 4) {
        order(row[i], row[i + 3]);
        order(row[i + 1], row[i + 2]);
        order(row[i], row[i + 1]);
        order(row[i + 2], row[i + 3]);
    }
    for (uint32_t i = 0; i < 4; ++i)
        order(row[i], row[7 - i]);
    for (uint32_t i = 0; i < 8; i += 4) {
        order(row[i], row[i + 2]);
        order(row[i + 1], row[i + 3]);
        order(row[i], row[i + 1]);
        order(row[i + 2], row[i + 3]);
    }
}

/// Applies `what` to each block of rows.
template <class V, class What>
HWY_INLINE void forEachBlock(typename Lanes<V>::Scalar* numbers, uint32_t count, What what)
{
    for (uint32_t begin = 0; begin < count; begin += kSortBlock) {
        auto* const at = numbers + size_t(begin) * Lanes<V>::kWidth;
        V row[kSortBlock];
        for (uint32_t i = 0; i < kSortBlock; ++i)
            row[i] = Lanes<V>::load(at + i * Lanes<V>::kWidth);
        what(row);
        for (uint32_t i = 0; i < kSortBlock; ++i)
            Lanes<V>::store(at + i * Lanes<V>::kWidth, row[i]);
    }
}

template <class V>
HWY_INLINE void orderRows(typename Lanes<V>::Scalar* numbers, uint32_t low, uint32_t high)
{
    V a = Lanes<V>::load(numbers + size_t(low) * Lanes<V>::kWidth);
    V b = Lanes<V>::load(numbers + size_t(high) * Lanes<V>::kWidth);
    order(a, b);
    Lanes<V>::store(numbers + size_t(low) * Lanes<V>::kWidth, a);
    Lanes<V>::store(numbers + size_t(high) * Lanes<V>::kWidth, b);
}

/// Sorts, lane by lane, `count` numbers that stand `Lanes<V>::kWidth` apart; rows behind them, up to a whole
/// block, are used as well. Bitonic merges that all order upwards, so that rows beyond the end can be thought
/// as infinite: the comparisons do not depend on the numbers, and lanes never part. [KNU98] 5.3.4
template <class V>
void sortLanes(typename Lanes<V>::Scalar* numbers, uint32_t count)
{
    using T = typename Lanes<V>::Scalar;
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    if constexpr (kWidth == 1) {
        std::sort(numbers, numbers + count);
        return;
    }
    const uint32_t rows = (count + kSortBlock - 1) / kSortBlock * kSortBlock;
    std::fill(numbers + size_t(count) * kWidth, numbers + size_t(rows) * kWidth,
              std::numeric_limits<T>::infinity());
    forEachBlock<V>(numbers, rows, [](V* row) { sortBlock(row); });
    for (uint32_t size = 2 * kSortBlock; size / 2 < rows; size *= 2) {
        for (uint32_t begin = 0; begin + size / 2 < rows; begin += size)
            for (uint32_t i = begin + size > rows ? begin + size - rows : 0; i < size / 2; ++i)
                orderRows<V>(numbers, begin + i, begin + size - 1 - i);
        for (uint32_t half = size / 4; half >= kSortBlock; half /= 2)
            for (uint32_t begin = 0; begin + half < rows; begin += 2 * half)
                for (uint32_t i = begin; i < std::min(begin + half, rows - half); ++i)
                    orderRows<V>(numbers, i, i + half);
        forEachBlock<V>(numbers, rows, [](V* row) { mergeBlock(row); });
    }
}

/// Powers of two that bound what goes into products, so that none leaves the range of T.
template <class T>
struct Range
{
    static constexpr bool kIsFloat = Real<T>::kDigits <= 24;
    /// [1] Optical depth of a radius. The weight of the smallest blob is then below 2^114: a float holds the
    /// sum of 8000 of them.
    static constexpr int kDeepest = 14;
    static constexpr int kBrightest = kIsFloat ? 100 : 900; ///< [cd/m2] source
    static constexpr int kFarthest = kIsFloat ? 60 : 500;   ///< place, scaled: nothing there has a length
    static T power(int exponent) { return static_cast<T>(std::ldexp(1.0, exponent)); }
    /// The largest that is not above x, 1 for x = 0. Scaling by it is exact: the unit of x does not matter.
    static T powerBelow(T x)
    {
        int exponent = 0;
        std::frexp(static_cast<double>(x), &exponent);
        return x > T(0) ? power(exponent - 1) : T(1);
    }
};

/// The blobs of a group, in lengths of which the largest radius is between 1 and 2, and in light of which the
/// brightest source is.
template <class V, int kDegree, bool kProduct>
class IntervalWalk
{
public:
    using T = typename Lanes<V>::Scalar;
    static constexpr uint32_t kWidth = Lanes<V>::kWidth;
    static constexpr int kTerms = 2 * kDegree + 1;
    /// Radius of a blob beside the largest: below, (R_max / R)^(2 degree) leaves the range of a float.
    static constexpr double kSmallest = 1.0 / (1u << (kDegree == 2 ? 20 : kDegree == 3 ? 13 : 10));

    IntervalWalk(GroupScratch<T>& scratch, RayWork* work) : scratch_(scratch), work_(work) {}

    /// @param shared anything with radius, extinction, source[3] for each blob, in the order of summation
    /// @return 1 in lanes that meet a blob which was left out as too small
    template <class Shared>
    V begin(const GroupInput<T>& input, const Shared* shared);

    /// Calls rule.interval(begin, length) for every interval between neighboring events that has a length in
    /// some lane, from front to back, until rule.isDone(); then rule.finish().
    template <class Rule>
    void forEachInterval(Rule& rule);

    /// Where each lane's first blob begins and its last one ends.
    V firstEvent() const { return Lanes<V>::load(events_); }
    V lastEvent() const { return Lanes<V>::load(events_ + size_t(kWidth) * (2 * count_ - 1)); }
    uint32_t events() const { return 2 * count_; }
    T scale() const { return scale_; }
    /// [cd/m2] what light of 1 stands for.
    T lightUnit() const { return scratch_.lightUnit; }

    /// Prepares sumKernels() for places in [low, high]; both must not decrease between calls after rewind().
    HWY_INLINE void moveTo(T low, T high)
    {
        if (isCompared())
            compareAll(low, high);
        else
            stepTo(low, high);
    }
    void rewind();

    /// What sums need, without this class: local copies stay in registers.
    BlobLanes<T> blobs() const
    {
        return {center_, chord2_, weights_, scratch_.candidates.data(), words_, {nearby_[0], nearby_[1]}};
    }
    RayWork* work() { return work_; }

private:
    template <class Shared>
    void weigh(const GroupInput<T>& input, const Shared* shared);
    void chooseUnits(T largest, T brightest);
    void takeRoom();
    /// Where lanes enter and leave each blob. @return as begin()
    template <class Shared>
    V meetBlobs(const GroupInput<T>& input, const Shared* shared);
    void orderEvents();
    /// Blobs that a lane misses get events where the lane has some already, so that they split nothing, and
    /// the lanes keep step: before the middle of a ray at its front, otherwise at its back.
    void placeMisses(V front, V back);
    /// Few blobs and many lanes: candidates come from comparing all blobs at once.
    bool isCompared() const { return kWidth > 1 && count_ <= 256; }
    HWY_INLINE void compareAll(T low, T high);
    void stepTo(T low, T high);
    void orderCandidates();
    bool hasCandidates() const
    {
        for (uint32_t word = 0; word < words_; ++word)
            if (scratch_.candidates[word] != 0)
                return true;
        return false;
    }

    GroupScratch<T>& scratch_;
    RayWork* work_;
    uint32_t count_ = 0;
    uint32_t words_ = 0;
    T scale_ = T(1);
    T* center_ = nullptr;
    T* chord2_ = nullptr;
    T* events_ = nullptr;
    T* weights_ = nullptr;
    NearbyBlobs<T> nearby_[2]{};
    uint32_t entered_ = 0, left_ = 0;
};

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::chooseUnits(T largest, T brightest)
{
    // Mostly those of the group before.
    if (!(scratch_.largest == largest)) {
        scratch_.unit = Range<T>::powerBelow(largest);
        scratch_.largest = largest;
    }
    if (!(scratch_.brightest == brightest)) {
        scratch_.lightUnit = Range<T>::powerBelow(std::min(brightest, Range<T>::power(Range<T>::kBrightest)));
        scratch_.brightest = brightest;
    }
    scale_ = T(1) / scratch_.unit;
}

/// Extinction is bounded before it becomes part of a product. What is cut off could not be seen but at the
/// rim: of a blob that is thicker still, half of the light passes at 0.991 radii, not beyond.
template <class V, int kDegree, bool kProduct>
template <class Shared>
void IntervalWalk<V, kDegree, kProduct>::weigh(const GroupInput<T>& input, const Shared* shared)
{
    chooseUnits(input.largest, input.brightest);
    const T unit = scratch_.unit;
    const T perLight = T(1) / scratch_.lightUnit;
    const T deepest = Range<T>::power(Range<T>::kDeepest);
    const T brightest = Range<T>::power(Range<T>::kBrightest);
    weights_ = scratch_.weights.room(size_t(count_) * 4);
    for (uint32_t i = 0; i < count_; ++i) {
        const T radius = shared[i].radius * scale_;
        T* w = weights_ + size_t(i) * 4;
        const bool isThere = !(radius < static_cast<T>(kSmallest));
        const T perRadius2 = isThere ? T(1) / (radius * radius) : T(0);
        T kernel = perRadius2;
        for (int k = 1; k < kDegree; ++k)
            kernel = kernel * perRadius2;
        const T extinction = std::min(shared[i].extinction, deepest / shared[i].radius);
        w[0] = isThere ? extinction * unit * kernel : T(0);
        for (int c = 0; c < 3; ++c)
            w[c + 1] =
                isThere ? (kProduct ? kernel : w[0]) * (std::min(shared[i].source[c], brightest) * perLight)
                        : T(0);
    }
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::placeMisses(V front, V back)
{
    const V middle = (front + back) * Lanes<V>::all(T(0.5));
    for (uint32_t i = 0; i < count_; ++i) {
        T* pair = events_ + size_t(2 * i) * kWidth;
        const V first = Lanes<V>::load(pair);
        V last = Lanes<V>::load(pair + kWidth);
        if (countLess(first, last) < kWidth) {
            const V place = chooseLess(Lanes<V>::load(center_ + size_t(i) * kWidth), middle, front, back);
            const V begin = chooseLess(first, last, first, place);
            last = chooseLess(first, last, last, place);
            Lanes<V>::store(pair, begin);
            Lanes<V>::store(pair + kWidth, last);
        }
    }
    foldRows<V, true>(events_, size_t(2) * kWidth, count_, scratch_.first.data());
    foldRows<V, false>(events_ + kWidth, size_t(2) * kWidth, count_, scratch_.last.data());
    const size_t padded = scratch_.first.size() - kWidth;
    for (size_t i = count_; i < padded; ++i) { // never between
        scratch_.first[i] = std::numeric_limits<float>::max();
        scratch_.last[i] = T(0) - scratch_.first[i];
    }
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::takeRoom()
{
    const size_t lanes = size_t(count_) * kWidth;
    center_ = scratch_.center.room(lanes);
    chord2_ = scratch_.chord2.room(lanes);
    constexpr size_t kBehind = 2 * std::max(kSortBlock, kFoldedRows); // rows that loops may reach
    events_ = scratch_.events.room(2 * lanes + kBehind * kWidth);
    std::fill_n(events_ + 2 * lanes, kBehind * kWidth, T(0));
    scratch_.nearby.resize(2 * size_t(count_));
    T* offset = scratch_.offset.room(2 * lanes);
    T* square = scratch_.square.room(2 * lanes);
    T* margin = scratch_.margin.room(2 * lanes);
    for (uint32_t i = 0; i < 2; ++i)
        nearby_[i] = {offset + i * lanes, square + i * lanes, margin + i * lanes,
                      scratch_.nearby.data() + i * size_t(count_), scratch_.nearbyCount + i};
    const size_t padded = (size_t(count_) + kWidth - 1) / kWidth * kWidth;
    scratch_.first.resize(padded + kWidth);
    scratch_.last.resize(padded + kWidth);
}

template <class V, int kDegree, bool kProduct>
template <class Shared>
V IntervalWalk<V, kDegree, kProduct>::meetBlobs(const GroupInput<T>& input, const Shared* shared)
{
    const V scale = Lanes<V>::all(scale_);
    const V scale2 = Lanes<V>::all(scale_ * scale_);
    const V zero = Lanes<V>::all(T(0));
    const V far = Lanes<V>::all(Range<T>::power(Range<T>::kFarthest));
    const V nearest = Lanes<V>::load(input.nearest) * scale;
    const V farthest = larger(nearest, Lanes<V>::load(input.farthest) * scale);
    V front = Lanes<V>::all(std::numeric_limits<float>::max());
    V back = zero - front;
    V missing = zero;
    for (uint32_t i = 0; i < count_; ++i) {
        const V center =
            smaller(larger(Lanes<V>::load(input.center + size_t(i) * input.stride) * scale, zero - far), far);
        const V chord2 = larger(zero, Lanes<V>::load(input.chord2 + size_t(i) * input.stride) * scale2);
        const V half = root(chord2);
        const V first = smaller(larger(center - half, nearest), farthest);
        const V last = smaller(larger(center + half, nearest), farthest);
        Lanes<V>::store(center_ + size_t(i) * kWidth, center);
        Lanes<V>::store(chord2_ + size_t(i) * kWidth, chord2);
        Lanes<V>::store(events_ + size_t(2 * i) * kWidth, first);
        Lanes<V>::store(events_ + size_t(2 * i + 1) * kWidth, last);
        front = chooseLess(first, last, smaller(front, first), front);
        back = chooseLess(first, last, larger(back, last), back);
        if (shared[i].radius * scale_ < static_cast<T>(kSmallest))
            missing = chooseLess(zero, chord2, Lanes<V>::all(T(1)), missing);
        if (work_)
            work_->hits += countLess(first, last);
    }
    const V any = Lanes<V>::load(center_); // of lanes that meet nothing: near, so that no power overflows
    placeMisses(chooseLess(back, front, any, front), chooseLess(back, front, any, back));
    return missing;
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::orderEvents()
{
    sortLanes<V>(events_, 2 * count_);
    scratch_.low.resize(2 * size_t(count_) + kWidth);
    scratch_.high.resize(2 * size_t(count_) + kWidth);
    foldRows<V, true>(events_, kWidth, 2 * count_, scratch_.low.data());
    foldRows<V, false>(events_, kWidth, 2 * count_, scratch_.high.data());
}

template <class V, int kDegree, bool kProduct>
template <class Shared>
V IntervalWalk<V, kDegree, kProduct>::begin(const GroupInput<T>& input, const Shared* shared)
{
    count_ = input.count;
    for (uint32_t i = 0; i < count_; ++i) {
        __builtin_prefetch(input.center + size_t(i) * input.stride);
        __builtin_prefetch(input.chord2 + size_t(i) * input.stride);
    }
    weigh(input, shared);
    takeRoom();
    const V missing = meetBlobs(input, shared);
    orderEvents();
    words_ = (count_ + 63) / 64;
    if (!isCompared())
        orderCandidates();
    rewind();
    return missing;
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::orderCandidates()
{
    scratch_.byFirst.resize(count_);
    scratch_.byLast.resize(count_);
    std::iota(scratch_.byFirst.begin(), scratch_.byFirst.end(), 0u);
    std::iota(scratch_.byLast.begin(), scratch_.byLast.end(), 0u);
    const T* firsts = scratch_.first.data();
    const T* lasts = scratch_.last.data();
    std::sort(scratch_.byFirst.begin(), scratch_.byFirst.end(),
              [firsts](uint32_t a, uint32_t b) { return firsts[a] < firsts[b]; });
    std::sort(scratch_.byLast.begin(), scratch_.byLast.end(),
              [lasts](uint32_t a, uint32_t b) { return lasts[a] < lasts[b]; });
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::rewind()
{
    scratch_.candidates.assign(words_, 0);
    entered_ = left_ = 0;
}

template <class V, int kDegree, bool kProduct>
HWY_INLINE void IntervalWalk<V, kDegree, kProduct>::compareAll(T low, T high)
{
    uint64_t* bits = scratch_.candidates.data();
    const T* firsts = scratch_.first.data();
    const T* lasts = scratch_.last.data();
    const V least = Lanes<V>::all(low), most = Lanes<V>::all(high);
    const uint32_t count = count_;
    for (uint32_t begin = 0; begin < count; begin += 64) {
        uint64_t word = 0;
        for (uint32_t i = begin; i < std::min(begin + 64, count); i += kWidth) {
            const uint64_t mayMatter =
                bitsLess(Lanes<V>::load(firsts + i), most) & bitsLess(least, Lanes<V>::load(lasts + i));
            word |= mayMatter << (i % 64);
        }
        bits[begin / 64] = word;
    }
}

template <class V, int kDegree, bool kProduct>
void IntervalWalk<V, kDegree, kProduct>::stepTo(T low, T high)
{
    uint64_t* bits = scratch_.candidates.data();
    for (; entered_ < count_ && !(high < scratch_.first[scratch_.byFirst[entered_]]); ++entered_)
        bits[scratch_.byFirst[entered_] / 64] |= uint64_t(1) << (scratch_.byFirst[entered_] % 64);
    // A blob that has ended has begun before, since no blob ends before it begins.
    for (; left_ < count_ && !(low < scratch_.last[scratch_.byLast[left_]]); ++left_)
        bits[scratch_.byLast[left_] / 64] &= ~(uint64_t(1) << (scratch_.byLast[left_] % 64));
}

template <class V, int kDegree, bool kProduct>
template <class Rule>
void IntervalWalk<V, kDegree, kProduct>::forEachInterval(Rule& rule)
{
    const V zero = Lanes<V>::all(T(0));
    rewind();
    V begin = firstEvent();
    for (uint32_t k = 1; k < 2 * count_ && !rule.isDone(); ++k) {
        const V end = Lanes<V>::load(events_ + size_t(k) * kWidth);
        const V length = end - begin;
        if (anyLess(zero, length)) {
            moveTo(scratch_.low[k - 1], scratch_.high[k]);
            if (hasCandidates()) {
                if (work_)
                    work_->intervals += countLess(zero, length);
                rule.interval(begin, length);
            }
        }
        begin = end;
    }
    rule.finish();
}

// The sums below have no choice of order: blobs by increasing id, in every lane alike.
