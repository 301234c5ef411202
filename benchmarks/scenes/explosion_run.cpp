#include "benchmarks/scenes/explosion_run.h"

#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/techniques.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace fx::cli {
namespace {

constexpr base::Ticks kStep = base::kTicksPerSecond / kExplosionFrames;
constexpr uint64_t kSeed = 7;

base::SnapshotSchema allKinds()
{
    base::SnapshotSchema schema;
    preset::registerKinds(schema);
    return schema;
}

base::Result<sim::GasDef> libraryGas()
{
    for (const base::EmbeddedText& text : preset::presetLibrary()) {
        if (text.name != "explosion.fx.json")
            continue;
        const base::Result<preset::LoadedPreset> loaded = preset::loadPresetText(text.text, "explosion");
        if (!loaded)
            return loaded.status();
        for (const auto& solver : loaded->effect->solvers)
            if (const auto* gas = dynamic_cast<const sim::GasDef*>(solver.get()))
                return *gas;
    }
    return base::Status(base::Code::NotFound, "the library has no explosion of gas");
}

} // namespace

base::Result<std::unique_ptr<ExplosionRun>> ExplosionRun::create(const ExplosionSetting& setting,
                                                                 base::TaskRunner& tasks)
{
    base::Result<sim::GasDef> gas = libraryGas();
    if (!gas)
        return gas.status();
    gas->particles = setting.particles;
    if (setting.soundSpeed >= 0)
        gas->soundSpeed = setting.soundSpeed;
    sim::Quality quality;
    quality.flowMach = setting.flowMach;
    return std::make_unique<ExplosionRun>(*gas, quality, tasks);
}

ExplosionRun::ExplosionRun(const sim::GasDef& gas, const sim::Quality& quality, base::TaskRunner& tasks)
    : def_(gas), tasks_(tasks), schema_(allKinds()), solver_(def_.create(schema_, quality, &memory_)),
      arena_(&memory_, 1 << 20), snapshot_(&schema_, &memory_)
{}

void ExplosionRun::step()
{
    solver_->step({frame_ * kStep,
                   kStep,
                   kSeed,
                   0,
                   {0, -9.80665f, 0},
                   {0, 0, 0},
                   0.0f,
                   nullptr,
                   &parameters_,
                   &tasks_,
                   &arena_,
                   &counters_});
    ++frame_;
}

const base::FrameSnapshot& ExplosionRun::publish()
{
    snapshot_.begin(frame_ * kStep, snapshot_.sequence() + 1);
    solver_->publish({}, snapshot_);
    return snapshot_;
}

ExplosionState ExplosionRun::look()
{
    publish();
    ExplosionState sum{};
    double count = 0;
    for (size_t g = 0; g < snapshot_.groupCount(); ++g) {
        const base::SnapshotGroup& group = snapshot_.group(g);
        const auto at = [&group](size_t column, size_t i) { return double(group.column(column)[i]); };
        for (size_t i = 0; i < group.info().count; ++i) {
            using namespace base::blob_column;
            const double x = at(PositionX, i), z = at(PositionZ, i);
            const double u = at(VelocityX, i), v = at(VelocityY, i), w = at(VelocityZ, i);
            sum.height += at(PositionY, i);
            sum.radius += x * x + z * z;
            sum.speed += u * u + v * v + w * w;
            sum.temperature += at(Temperature, i);
            ++count;
        }
    }
    if (count == 0)
        return {};
    return {sum.height / count, std::sqrt(sum.radius / count), std::sqrt(sum.speed / count),
            sum.temperature / count};
}

double ExplosionRun::nearestOverSpacing()
{
    using namespace base::blob_column;
    publish();
    if (snapshot_.groupCount() == 0)
        return 0;
    const base::SnapshotGroup& group = snapshot_.group(0);
    const auto x = group.column(PositionX), y = group.column(PositionY), z = group.column(PositionZ);
    const double neighbors = double(sim::Quality{}.neighbors);
    const double perRadius = 2.0 / double(def_.growth) / std::cbrt(0.75 * neighbors / std::numbers::pi);
    std::vector<double> nearest;
    for (size_t i = 0; i < group.count(); ++i) {
        float least = 1e30f;
        for (size_t j = 0; j < group.count(); ++j) {
            const float dx = x[i] - x[j], dy = y[i] - y[j], dz = z[i] - z[j];
            const float square = dx * dx + dy * dy + dz * dz;
            least = std::min(least, j == i ? least : square);
        }
        nearest.push_back(std::sqrt(double(least)) / (perRadius * double(group.column(Radius)[i])));
    }
    if (nearest.empty())
        return 0;
    std::nth_element(nearest.begin(), nearest.begin() + std::ptrdiff_t(nearest.size() / 2), nearest.end());
    return nearest[nearest.size() / 2];
}

} // namespace fx::cli
