#include "simulation/particles/birth_kernel.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/motion/blob_optics.h"
#include "simulation/particles/birth_rows.h"

#include <algorithm>
#include <bitset>

namespace fx::sim {

namespace {

using base::RandomPurpose;

constexpr float kPi = 3.14159265f;
constexpr float kSmallestBirthScale = 0.1f; // a curve that starts at size 0 still defines an optical depth

/// A tile of births on its way into the store.
template <class Rows>
class BirthBatch
{
public:
    BirthBatch(const ParticleProgram& program, const BirthKey& key, const Rows& rows)
        : program_(program), def_(program.def), key_(key), rows_(rows)
    {
        tile_.count = rows.count();
        rows.prepare(tile_);
    }

    uint32_t run()
    {
        findRows();
        if (free_.none())
            return 0;
        storeMotion();
        storeAppearance();
        return uint32_t(free_.count());
    }
    bool isFree(uint32_t i) const { return free_[i]; }

private:
    void draw(RandomPurpose purpose) { drawUnits(tile_, key_.seed, key_.solver, uint32_t(purpose), tile_.u); }
    bool stores(size_t column) const { return program_.stores[column]; }

    void findRows();
    void samplePlaces();
    void storeMotion();
    void storeAppearance();
    void storeMedium();
    void storeRange(size_t column, const base::Range& range, uint32_t number);
    void put(size_t column, const float* values);

    const ParticleProgram& program_;
    const EmitterSettings& def_;
    const BirthKey key_;
    const Rows& rows_;
    std::bitset<kTileRows> free_; ///< births that find their row free
    BirthTile tile_;
};

template <class Rows>
void BirthBatch<Rows>::put(size_t column, const float* values)
{
    float* const run = free_.count() == tile_.count ? rows_.run(column) : nullptr;
    if (run) {
        std::copy_n(values, tile_.count, run);
        return;
    }
    rows_.forEach([&](ParticleStore& store, uint32_t row, uint32_t i) {
        if (free_[i])
            store.values[column][row] = values[i];
    });
}

template <class Rows>
void BirthBatch<Rows>::storeRange(size_t column, const base::Range& range, uint32_t number)
{
    if (!stores(column))
        return;
    for (uint32_t i = 0; i < tile_.count; ++i)
        tile_.value[i] = range.at(tile_.u[number][i]);
    put(column, tile_.value);
}

template <class Rows>
void BirthBatch<Rows>::findRows()
{
    rows_.forEach([this](ParticleStore& store, uint32_t row, uint32_t i) {
        const Birth& birth = rows_.birth(i);
        free_[i] = Rows::kAreFree || !store.isAlive(row, birth.tick);
        if (!free_[i])
            return;
        store.index[row] = birth.index;
        store.born[row] = birth.tick;
        if (store.bornShort.data())
            store.bornShort[row] = uint32_t(birth.tick);
        if (store.flags.data())
            store.flags[row] = 0;
    });
}

template <class Rows>
void BirthBatch<Rows>::samplePlaces()
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

template <class Rows>
void BirthBatch<Rows>::storeMotion()
{
    samplePlaces();
    const glm::vec3 center = def_.births ? glm::vec3(0.0f) : def_.position; // they know their own
    if (rows_.first().placed)
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

template <class Rows>
void BirthBatch<Rows>::storeMedium()
{
    const float birthScale = std::max(def_.sizeOverLife.at(0.0f)[0], kSmallestBirthScale);
    for (uint32_t i = 0; i < tile_.count; ++i) {
        const float amount = def_.crossSection.at(tile_.u[1][i]);
        const float radius = def_.radius.at(tile_.u[0][i]);
        tile_.value[i] = def_.opticalDepthGiven ? crossSectionOf(amount, radius * birthScale) : amount;
    }
    put(stored::Amount, tile_.value);
}

template <class Rows>
void BirthBatch<Rows>::storeAppearance()
{
    const bool medium = def_.appearance.kind == AppearanceKind::Medium;
    if (stores(stored::Radius) || stores(stored::Amount) || stores(stored::Excess) ||
        stores(stored::Brightness))
        draw(RandomPurpose::Attributes);
    storeRange(stored::Radius, def_.radius, 0);
    if (medium)
        storeMedium();
    else
        storeRange(stored::Amount, def_.appearance.opacity, 1);
    storeRange(stored::Excess,
               {def_.temperature.min - kAirTemperature, def_.temperature.max - kAirTemperature}, 2);
    storeRange(stored::Brightness, def_.appearance.brightness, 3);
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
    storeRange(stored::Angle, def_.appearance.angle, 0);
    storeRange(stored::Spin, def_.appearance.spin, 1);
    storeRange(stored::Frame, def_.appearance.firstFrame, 2);
}

} // namespace

uint32_t storeBirths(const ParticleProgram& program, const BirthKey& key, std::span<const Birth> births,
                     ParticleStore& store)
{
    uint32_t living = 0;
    for (size_t begin = 0; begin < births.size(); begin += kTileRows) {
        const size_t size = std::min<size_t>(births.size() - begin, kTileRows);
        const RowsOfOne rows(births.subspan(begin, size), store);
        living += BirthBatch<RowsOfOne>(program, key, rows).run();
    }
    return living;
}

void storePooled(const ParticleProgram& program, uint32_t solver, std::span<const PooledBirth> births,
                 ParticleStore& store)
{
    for (size_t begin = 0; begin < births.size(); begin += kTileRows) {
        const size_t size = std::min<size_t>(births.size() - begin, kTileRows);
        const RowsOfPool rows(births.subspan(begin, size), store);
        static_cast<void>(BirthBatch<RowsOfPool>(program, {0, solver}, rows).run());
    }
}

void storeScattered(const ParticleProgram& program, uint32_t solver, std::span<ScatteredBirth> births)
{
    for (size_t begin = 0; begin < births.size(); begin += kTileRows) {
        const size_t size = std::min<size_t>(births.size() - begin, kTileRows);
        const RowsOfMany rows(births.subspan(begin, size));
        BirthBatch<RowsOfMany> batch(program, {0, solver}, rows);
        static_cast<void>(batch.run());
        for (uint32_t i = 0; i < size; ++i)
            births[begin + i].isStored = batch.isFree(i);
    }
}

} // namespace fx::sim
