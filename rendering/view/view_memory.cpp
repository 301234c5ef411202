// What a view makes and gives back: the parts of its techniques, the statistics of frames, and frames in
// which there is nothing to draw.
#include "rendering/particle_rows/row_technique.h"
#include "rendering/view/view_parts.h"

#include <algorithm>

namespace fx::render {

namespace {

PassGroups passGroupsOf(DrawTechniques list)
{
    PassGroups groups = passGroups(list);
    for (const MediaComposition* composition : mediaCompositions())
        groups.add(composition->timedPasses);
    return groups;
}

} // namespace

ViewRenderer::Impl::Impl(GlDevice* d, const base::SnapshotSchema* kinds, std::pmr::memory_resource* heap,
                         DrawTechniques list)
    : device(d), schema(kinds), memory(heap), graph(memory), backend(*d, memory), lightGraph(memory),
      lightBackend(*d, memory), techniques(list), parts(memory),
      composing(findComposition(Composition::Sorted)), lod(memory), lights(d, memory), casters(memory),
      batcher(memory), streams(memory), solids(memory), revisions(memory), passNames(memory), targetCheck(*d),
      copies(*d), timer(*d, passGroupsOf(list)), lightTimer(*d, timer.groups())
{
    const TechniqueSetup setup{d, schema, memory, list};
    for (size_t i = 0; i < list.size(); ++i) {
        const auto isMadeAlready = [&](const DrawTechnique* before) {
            return before->create == list[i]->create;
        };
        if (list[i]->create && std::ranges::none_of(list.first(i), isMadeAlready))
            parts.push_back(list[i]->create(setup));
        if (list[i]->rows && !list[i]->rows->isComputed)
            revisions.stampRowsOf(*list[i]->kind);
    }
}

void ViewRenderer::Impl::compose(const ViewSettings& settings)
{
    const bool hasOutputs = settings.outputs != 0;
    if (composing->value == settings.composition && hasOutputs == (outputView != nullptr))
        return;
    const MediaComposition* found = findComposition(settings.composition);
    key.reset();
    if (composition)
        parts.pop_back();
    if (outputView)
        parts.pop_back();
    composition = nullptr;
    outputView = nullptr;
    composing = found;
    if (hasOutputs) {
        auto made = std::make_unique<OutputView>(TechniqueSetup{device, schema, memory, techniques});
        outputView = made.get();
        parts.push_back(std::move(made));
    }
    if (!found->create)
        return;
    std::unique_ptr<CompositionView> made = found->create({device, schema, memory, techniques});
    composition = made.get();
    parts.push_back(std::move(made));
}

uint64_t ViewRenderer::Impl::bytes() const
{
    uint64_t sum = copies.bytes() + backend.pooledBytes() + lightBackend.pooledBytes() + lights.bytes();
    for (const auto& part : parts)
        sum += part->bytes();
    return sum;
}

/// A frame in which there is nothing to draw.
FrameStatistics ViewRenderer::Impl::rest()
{
    outputs = {};
    dropPrepared();
    isOpen = false;
    hasLights = false;
    passNames.clear();
    FrameStatistics statistics;
    const uint64_t before = device->callCount();
    ++idleFrames;
    for (GlBackend* one : {&backend, &lightBackend})
        if (idleFrames >= kIdleFrames && one->pooledBytes() > 0)
            one->releasePool();
    if (idleFrames == kIdleFrames) {
        lights.release();
        copies.release();
    }
    for (const auto& part : parts)
        part->rest();
    if (idleFrames == kIdleFrames)
        key.reset();
    statistics.glCalls = device->callCount() - before;
    statistics.textureBytes = bytes();
    return statistics;
}

bool ViewRenderer::Impl::holdsNothing() const
{
    return bytes() == 0 && !key;
}

/// What the frame has drawn.
FrameStatistics ViewRenderer::Impl::count(int divisor)
{
    FrameStatistics statistics;
    for (const auto& part : parts)
        part->count(statistics);
    std::copy(lod.counts().begin(), lod.counts().end(), statistics.lodGroups);
    statistics.keptLists = keptLists;
    statistics.passes = uint32_t(passNames.size());
    statistics.drawCalls = outputs.anyPass ? backend.drawCalls() : 0;
    statistics.textureBytes = bytes();
    if (outputs.anyPass) {
        statistics.unsharedBytes = graph.memory().unshared;
        statistics.sharedBytes = graph.memory().shared;
    }
    statistics.estimatedFragments = fragments[layerDivisorIndex(divisor)];
    statistics.layerDivisor = divisor;
    return statistics;
}

/// Of the frame that was drawn, with those that had prepared it. draw() has made room: once the host's
/// picture has changed, nothing may run out of memory.
void ViewRenderer::Impl::namePasses(bool wasPrepared)
{
    passNames.clear();
    const auto add = [&](const FrameGraph& from) {
        const auto names = from.executedPasses();
        passNames.insert(passNames.end(), names.begin(), names.end());
    };
    if (wasPrepared)
        add(lightGraph);
    if (outputs.anyPass)
        add(graph);
}

} // namespace fx::render
