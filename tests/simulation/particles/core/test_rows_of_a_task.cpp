// Loops over particles are cut for other threads where that is worth it, and with the same bits.
#include "simulation/particles/rows_of_a_task.h"
#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace fx;
using namespace fx::test;

namespace {

/// A host that cuts each loop into its smallest parts and counts those of the loop with the most.
struct CuttingHost
{
    uint32_t mostParts = 0;

    std::unique_ptr<base::TaskRunner> runner()
    {
        return base::makeHostRunner(
            {this, [](void* user, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument) {
                 uint32_t parts = 0;
                 for (uint32_t begin = 0; begin < count; begin += minBatch, ++parts)
                     body(argument, begin, std::min(begin + minBatch, count));
                 uint32_t& most = static_cast<CuttingHost*>(user)->mostParts;
                 most = std::max(most, parts);
             }});
    }
};

/// Only what all sprites have: as cheap as they come.
std::unique_ptr<sim::EmitterDef> leanEmitter(uint32_t particles)
{
    auto def = rateEmitter(0.0f);
    def->appearance.kind = sim::AppearanceKind::Sprite;
    def->lifetime = {2.0f, 2.0f};
    def->radius = {0.05f, 0.05f};
    def->emission.bursts = {{0.0f, particles}};
    def->maxParticles = particles;
    return def;
}

std::unique_ptr<sim::EmitterDef> richEmitter(uint32_t particles)
{
    auto def = spriteEmitter(0.0f, {1.0f, 3.0f});
    def->appearance.angle = {0.0f, 6.0f};
    def->appearance.tileColumns = def->appearance.tileRows = 4;
    def->emission.bursts = {{0.0f, particles}};
    def->maxParticles = particles;
    return def;
}

/// The hash of what is published after the burst; the host counts the loops of that alone.
uint64_t play(std::unique_ptr<sim::EmitterDef> def, std::unique_ptr<base::TaskRunner> tasks,
              CuttingHost* host)
{
    Stage stage(std::move(tasks));
    stage.add({}, std::move(def));
    stage.play(3);
    if (host)
        host->mostParts = 0;
    return stage.look().hash();
}

} // namespace

TEST(RowsOfATask, fortyThousandLeanParticlesArePublishedByOneThread)
{
    CuttingHost host;
    play(leanEmitter(40'000), host.runner(), &host);
    EXPECT_LE(host.mostParts, 1u);
}

TEST(RowsOfATask, manyParticlesAreShared)
{
    CuttingHost host;
    play(leanEmitter(300'000), host.runner(), &host);
    EXPECT_GE(host.mostParts, 3u);
}

TEST(RowsOfATask, theMoreARowMovesTheFewerAPartHas)
{
    const auto lean = leanEmitter(1000);
    const auto rich = richEmitter(1000);
    const sim::ParticleProgram leanProgram(*lean), richProgram(*rich);
    for (const uint32_t chunk : {1u, 64u, 1024u}) {
        const uint32_t leanRows = sim::rowsOfATask(leanProgram, chunk);
        const uint32_t richRows = sim::rowsOfATask(richProgram, chunk);
        EXPECT_LT(richRows, leanRows);
        EXPECT_EQ(leanRows % chunk, 0u);
        EXPECT_NEAR(double(richRows * sim::bytesMoved(richProgram)), double(sim::kBytesOfATask),
                    double(chunk * sim::bytesMoved(richProgram)));
    }
}

TEST(RowsOfATask, partsGiveTheBitsOfTheWhole)
{
    CuttingHost host;
    EXPECT_EQ(play(richEmitter(120'000), host.runner(), &host),
              play(richEmitter(120'000), base::makeSerialRunner(), nullptr));
    EXPECT_GE(host.mostParts, 3u);
    EXPECT_EQ(play(richEmitter(120'000), base::makeTbbRunner(3), nullptr),
              play(richEmitter(120'000), base::makeSerialRunner(), nullptr));
}
