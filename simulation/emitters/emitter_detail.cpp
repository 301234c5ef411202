#include "simulation/emitters/emitter_detail.h"

#include "simulation/motion/drag_step.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr double kStrainOfTurbulence = 4.4; ///< [1] pi sqrt(2), over speed by scale
constexpr double kMinStrain = 0.25;         ///< [1/s] of a medium without turbulence
constexpr int kSizeSamples = 16;            ///< of the curve of sizes

/// Mean velocity of young particles, V of (4).
class Stream
{
public:
    Stream(const EmitterSettings& settings, const StepContext& context, double seconds)
        : perSecond_(float(1.0 / seconds)), drag_(makeDragStep(double(settings.forces.drag), seconds)),
          air_(context.wind + settings.forces.wind), gravity_(settings.forces.gravity * context.gravity),
          lift_(context.gravity * (-settings.forces.buoyancy / kAirTemperature))
    {}
    glm::vec3 velocity(const glm::vec3& now, float excess) const
    {
        return perSecond_ *
               (drag_.gain * now + drag_.drift * air_ + drag_.ramp * (gravity_ + excess * lift_));
    }

private:
    float perSecond_;
    DragStep drag_;
    glm::vec3 air_, gravity_, lift_;
};

/// Reads one row after the other; tiles are read once for rows that follow each other.
class RowReader
{
public:
    explicit RowReader(const AppearanceJob& job) : job_(job) {}
    void select(uint32_t row)
    {
        if (const uint32_t start = row / kTileRows * kTileRows; start != first_) {
            readMotion(job_, start, std::min(job_.rows.count - start, kTileRows), motion_);
            first_ = start;
        }
        i_ = row - first_;
    }
    glm::vec3 position() const { return at(motion_.position); }
    glm::vec3 velocity() const { return at(motion_.velocity); }

private:
    glm::vec3 at(const float (&values)[3][kTileRows]) const
    {
        return {values[0][i_], values[1][i_], values[2][i_]};
    }

    const AppearanceJob& job_;
    MotionTile motion_;
    uint32_t first_ = 1; // rows of a tile begin at multiples, so none is in hand
    uint32_t i_ = 0;
};

} // namespace

float meanRadiusOf(const EmitterSettings& settings)
{
    float sum = 0;
    for (int i = 0; i < kSizeSamples; ++i)
        sum += settings.sizeOverLife.at((float(i) + 0.5f) / float(kSizeSamples))[0];
    const float mean = 0.5f * (settings.radius.min + settings.radius.max) * sum / float(kSizeSamples);
    return std::max(mean, 1e-6f);
}

EmitterDetail::EmitterDetail(const EmitterDef& def, uint32_t capacity, std::pmr::memory_resource* memory)
    : def_(def), period_(periodOf(def)), coordinates_(memory, capacity)
{
    for (size_t g = 0; g < 2; ++g)
        shared_.radius[g] = shared_.radiusNow[g] = meanRadiusOf(def);
}

base::Ticks EmitterDetail::periodOf(const EmitterDef& def)
{
    const EmitterForces& forces = def.forces;
    const double strain =
        kStrainOfTurbulence * double(forces.curlStrength) / std::max(double(forces.curlScale), 1e-3);
    const double rate = double(def.detail.liveliness) * std::max(strain, kMinStrain) / kShearOfGeneration;
    return base::toTicks(1.0 / std::min(rate, kMaxGenerationRate)); // (2)
}

void EmitterDetail::begin(uint64_t next, base::Ticks now)
{
    next_ = next;
    younger_ = youngerAt(now);
}

template <class F>
void EmitterDetail::forEachLiving(const ParticleStore& store, base::Ticks now, F&& f)
{
    const RowWindow rows = store.window();
    for (uint32_t row = 0; row < rows.count; ++row)
        if ((row < rows.gapBegin || row >= rows.gapEnd) && store.isAlive(row, now))
            f(row);
}

void EmitterDetail::follow(const AppearanceJob& job, const StepContext& context)
{
    const uint64_t younger = youngerAt(job.now);
    for (uint64_t n = std::max(younger_ + 1, younger - 1); n <= younger; ++n)
        bear(job, n);
    younger_ = younger;
    adopt(job, context);
}

void EmitterDetail::bear(const AppearanceJob& job, uint64_t generation)
{
    const auto back = float(base::toSeconds(job.now - birthOf(generation)));
    RowReader reader(job);
    forEachLiving(*job.store, job.now, [&](uint32_t row) {
        reader.select(row);
        coordinates_.set(generation, row, reader.position() - back * reader.velocity()); // (3)
    });
}

/// Particles that were born in the step.
void EmitterDetail::adopt(const AppearanceJob& job, const StepContext& context)
{
    const ParticleStore& store = *job.store;
    const uint64_t first =
        std::max({next_, store.front(), store.next() - std::min<uint64_t>(store.next(), store.capacity())});
    next_ = store.next();
    const Stream stream(def_, context, base::toSeconds(period_));
    RowReader reader(job);
    for (uint64_t particle = first; particle < next_; ++particle) {
        const uint32_t row = store.rowOf(particle);
        if (store.index[row] != particle || !store.isAlive(row, job.now))
            continue;
        reader.select(row);
        const glm::vec3 velocity = stream.velocity(reader.velocity(), store.value(stored::Excess, row));
        for (const uint64_t n : {younger_ - 1, younger_}) {
            const auto since = float(base::toSeconds(job.now - birthOf(n)));
            coordinates_.set(n, row, reader.position() - since * velocity); // (4)
        }
    }
}

void EmitterDetail::open(base::Ticks now, base::KindId kind, uint32_t capacity,
                         base::FrameSnapshot& snapshot) const
{
    DetailGenerations generations = shared_;
    generations.younger = youngerAt(now);
    generations.fade = double(now % period_) / double(period_);
    addMaterial(def_.detail, generations, kind, capacity, snapshot);
}

void EmitterDetail::save(StateWriter& writer, const ParticleStore& store, base::Ticks now) const
{
    forEachLiving(store, now, [&](uint32_t row) {
        for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
            writer.value(coordinates_.value(c, row));
    });
}

void EmitterDetail::restore(StateReader& reader, const ParticleStore& store, base::Ticks now)
{
    begin(store.next(), now);
    forEachLiving(store, now, [&](uint32_t row) {
        float values[MaterialCoordinates::kColumns] = {};
        reader.values(std::span<float>(values));
        for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
            coordinates_.value(c, row) = values[c];
    });
}

} // namespace fx::sim
