#include "benchmarks/scenes/explosion_cards.h"

#include "benchmarks/scenes/explosion_run.h"
#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/tasks/task_runner.h"

#include <cmath>

namespace fx::cli {
namespace {

constexpr uint32_t kParticles = 800;
constexpr uint64_t kSeed = 270;
constexpr double kNanometers[3] = {610.0, 550.0, 465.0}; ///< of the three channels

/// @param share [0, 1) of the albedo that it sends
Card cardOf(const base::SnapshotGroup& group, size_t i, float share)
{
    using namespace base::blob_column;
    const auto at = [&](size_t column) { return group.column(column)[i]; };
    Card card{at(PositionX), at(PositionY) - 4.0f, 12.0f - at(PositionZ), at(Radius), at(CrossSection), {}};
    for (size_t k = 0; k < 3; ++k) {
        const double albedo = double(at(AlbedoR + k));
        const double glow = 2e6 * std::exp(-0.014388 / (kNanometers[k] * 1e-9 * double(at(Temperature))));
        card.emission[k] = float(0.2 * albedo * double(share) + (1.0 - albedo) * glow);
    }
    return card;
}

} // namespace

base::Result<std::vector<Card>> explosionCards(double seconds)
{
    const auto tasks = base::makeTbbRunner();
    const auto run = ExplosionRun::create({kParticles}, *tasks);
    if (!run)
        return run.status();
    for (int frame = 0; frame < int(std::lround(seconds * kExplosionFrames)); ++frame)
        (*run)->step();
    std::vector<Card> cards;
    const base::FrameSnapshot& snapshot = (*run)->publish();
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const base::SnapshotGroup& group = snapshot.group(g);
        if (snapshot.schema().kind(group.info().kind).name != base::kBlobKind.name)
            continue; // coordinates of detail
        for (size_t i = 0; i < group.count(); ++i) {
            const auto words = base::philox({uint32_t(group.ids()[i]), 2, 1, 0}, kSeed);
            cards.push_back(cardOf(group, i, base::toUnitFloat(words[1])));
        }
    }
    return cards;
}

} // namespace fx::cli
