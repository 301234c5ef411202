#include "simulation/particles/birth_kernel.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/particles/birth_lanes.h"

#include <algorithm>
#include <bitset>

namespace fx::sim {

namespace {

using base::RandomPurpose;

constexpr float kPi = 3.14159265f;
constexpr float kSmallestBirthScale = 0.1f; // a curve that starts at size 0 still defines an optical depth

/// A tile of births on its way into the store.
class BirthBatch
{
public:
    BirthBatch(const ParticleProgram& program, const BirthKey& key, std::span<const Birth> births,
               ParticleStore& store)
        : program_(program), def_(program.def), key_(key), births_(births), store_(store)
    {
        tile_.count = uint32_t(births.size());
        const uint32_t padded = (tile_.count + kTilePadding - 1) / kTilePadding * kTilePadding;
        for (uint32_t i = 0; i < padded; ++i) {
            const uint64_t index = births[0].index + i;
            tile_.indexLow[i] = uint32_t(index);
            tile_.indexHigh[i] = uint32_t(index >> 32);
        }
    }

    uint32_t run()
    {
        findRows();
        if (free_.none())
            return 0;
        storeMotion();
        storeLooks();
        return uint32_t(free_.count());
    }

private:
    void draw(RandomPurpose purpose) { drawUnits(tile_, key_.seed, key_.solver, uint32_t(purpose), tile_.u); }
    bool stores(size_t column) const { return program_.stores[column]; }

    void findRows();
    void samplePlaces();
    void storeMotion();
    void storeLooks();
    void storeMedium();
    void storeRange(size_t column, const base::Range& range, uint32_t number);
    void put(size_t column, const float* values);
    template <class T, class ValueOf>
    void putEach(base::Column<T>& column, ValueOf valueOf);

    const ParticleProgram& program_;
    const EmitterDef& def_;
    const BirthKey key_;
    std::span<const Birth> births_;
    ParticleStore& store_;
    std::bitset<kTileRows> free_; ///< births that find their row free
    BirthTile tile_;
};

template <class T, class ValueOf>
void BirthBatch::putEach(base::Column<T>& column, ValueOf valueOf)
{
    uint32_t row = store_.rowOf(births_[0].index);
    for (uint32_t i = 0; i < tile_.count; ++i) {
        if (free_[i])
            column[row] = valueOf(i);
        row = row + 1 == store_.capacity() ? 0 : row + 1;
    }
}

void BirthBatch::put(size_t column, const float* values)
{
    const uint32_t row = store_.rowOf(births_[0].index);
    if (free_.count() == tile_.count && row + tile_.count <= store_.capacity())
        std::copy_n(values, tile_.count, store_.values[column].data() + row);
    else
        putEach(store_.values[column], [values](uint32_t i) { return values[i]; });
}

void BirthBatch::storeRange(size_t column, const base::Range& range, uint32_t number)
{
    if (!stores(column))
        return;
    for (uint32_t i = 0; i < tile_.count; ++i)
        tile_.value[i] = range.at(tile_.u[number][i]);
    put(column, tile_.value);
}

void BirthBatch::findRows()
{
    uint32_t row = store_.rowOf(births_[0].index);
    for (uint32_t i = 0; i < tile_.count; ++i) {
        free_[i] = !store_.isAlive(row, births_[i].tick);
        row = row + 1 == store_.capacity() ? 0 : row + 1;
    }
    putEach(store_.index, [this](uint32_t i) { return births_[i].index; });
    putEach(store_.born, [this](uint32_t i) { return births_[i].tick; });
    if (store_.bornShort.data())
        putEach(store_.bornShort, [this](uint32_t i) { return uint32_t(births_[i].tick); });
    if (store_.flags.data())
        putEach(store_.flags, [](uint32_t) { return 0u; });
}

void BirthBatch::samplePlaces()
{
    const EmitterShape shape = def_.shape;
    if (def_.births || shape != EmitterShape::Point)
        draw(RandomPurpose::Position);
    if (def_.births || shape == EmitterShape::Point || shape == EmitterShape::Cone)
        drawUnits(tile_, key_.seed, key_.solver, uint32_t(RandomPurpose::Direction), tile_.heading);
    if (def_.births) {
        ShapeOp::Births births{};
        for (size_t k = 0; k < 4; ++k) {
            births.place[k] = tile_.u[k];
            births.heading[k] = tile_.heading[k];
        }
        for (size_t a = 0; a < 3; ++a) {
            births.position[a] = tile_.position[a];
            births.direction[a] = tile_.direction[a];
        }
        births.count = tile_.count;
        def_.births->sample(births);
        return;
    }
    const float angle = std::clamp(def_.angle, 0.0f, kPi);
    const float cosLimit = float(base::sinCosTurns(double(angle) / 6.283185307179586).cos);
    switch (shape) {
    case EmitterShape::Point:
        return sampleShape(LaneShape::Point, {}, -1.0f, tile_);
    case EmitterShape::Sphere:
        return sampleShape(LaneShape::Ball, def_.size, -1.0f, tile_);
    case EmitterShape::Box:
        return sampleShape(LaneShape::Box, def_.size, 1.0f, tile_);
    case EmitterShape::Cone:
        return sampleShape(LaneShape::Cone, def_.size, cosLimit, tile_);
    }
}

void BirthBatch::storeMotion()
{
    samplePlaces();
    const glm::vec3 center = def_.births ? glm::vec3(0.0f) : def_.position; // they know their own
    if (store_.placed)
        for (size_t a = 0; a < 3; ++a) {
            for (uint32_t i = 0; i < tile_.count; ++i)
                tile_.position[a][i] += center[int(a)];
            put(stored::X + a, tile_.position[a]);
        }
    if (stores(stored::PerLife) || def_.speed.max > def_.speed.min)
        draw(RandomPurpose::Life);
    else
        std::fill_n(tile_.u[1], kTileRows, 0.0f);
    for (size_t a = 0; a < 3; ++a) {
        for (uint32_t i = 0; i < tile_.count; ++i)
            tile_.value[i] = def_.speed.at(tile_.u[1][i]) * tile_.direction[a][i];
        put(stored::VelocityX + a, tile_.value);
    }
    if (!stores(stored::PerLife))
        return;
    const bool fixed = !(def_.lifetime.max > def_.lifetime.min); // a range of one value may be infinite
    for (uint32_t i = 0; i < tile_.count; ++i)
        tile_.value[i] = perLifeOf(fixed ? def_.lifetime.min : def_.lifetime.at(tile_.u[0][i]));
    put(stored::PerLife, tile_.value);
}

void BirthBatch::storeMedium()
{
    const float birthScale = std::max(def_.sizeOverLife.at(0.0f)[0], kSmallestBirthScale);
    for (uint32_t i = 0; i < tile_.count; ++i) {
        const float amount = def_.crossSection.at(tile_.u[1][i]);
        const float radius = def_.radius.at(tile_.u[0][i]);
        tile_.value[i] = def_.opticalDepthGiven ? crossSectionOf(amount, radius * birthScale) : amount;
    }
    put(stored::Amount, tile_.value);
}

void BirthBatch::storeLooks()
{
    const bool medium = def_.look.kind == Appearance::Medium;
    if (stores(stored::Radius) || stores(stored::Amount) || stores(stored::Excess) ||
        stores(stored::Brightness))
        draw(RandomPurpose::Attributes);
    storeRange(stored::Radius, def_.radius, 0);
    if (medium)
        storeMedium();
    else
        storeRange(stored::Amount, def_.look.opacity, 1);
    storeRange(stored::Excess,
               {def_.temperature.min - kAirTemperature, def_.temperature.max - kAirTemperature}, 2);
    storeRange(stored::Brightness, def_.look.brightness, 3);
    if (stores(stored::AxisX)) {
        draw(RandomPurpose::Axis);
        std::copy_n(&tile_.u[0][0], 4 * kTileRows, &tile_.heading[0][0]);
        sampleShape(LaneShape::Point, {}, -1.0f, tile_);
        for (size_t a = 0; a < 3; ++a)
            put(stored::AxisX + a, tile_.direction[a]);
    }
    if (!stores(stored::Angle) && !stores(stored::Spin) && !stores(stored::Frame))
        return;
    draw(RandomPurpose::Spin);
    storeRange(stored::Angle, def_.look.angle, 0);
    storeRange(stored::Spin, def_.look.spin, 1);
    storeRange(stored::Frame, def_.look.firstFrame, 2);
}

} // namespace

uint32_t storeBirths(const ParticleProgram& program, const BirthKey& key, std::span<const Birth> births,
                     ParticleStore& store)
{
    uint32_t living = 0;
    for (size_t begin = 0; begin < births.size(); begin += kTileRows) {
        const size_t size = std::min<size_t>(births.size() - begin, kTileRows);
        living += BirthBatch(program, key, births.subspan(begin, size), store).run();
    }
    return living;
}

} // namespace fx::sim
