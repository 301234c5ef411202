#include "rendering/techniques/draw_techniques.h"

#include "rendering/media/hot_areas.h"
#include "rendering/passes/heat_offset_pass.h"
#include "rendering/passes/heat_shimmer_pass.h"

namespace fx::render {

namespace {

constexpr TimedPass kPasses[] = {
    {"heat offset", "shimmer"}, {"heat shimmer", "shimmer"}, {"heat shimmer back", "shimmer"}};

constexpr const ProgramDesc* kPrograms[] = {&kHeatOffsetProgram, &kHeatShimmerProgram,
                                            &kHeatShimmerBackProgram};

/// Where the blobs that techniques before it have gathered are hot.
class ShimmerView final : public TechniqueView
{
public:
    explicit ShimmerView(const TechniqueSetup& setup) : areas_(setup.memory) {}

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override
    {
        blobs_ = uint32_t(io.blobs.size());
        const HostTargets& targets = in.request->targets;
        if (io.anyHeat && in.settings->shimmer.strength > 0.0f)
            areas_.find(io.blobs, in.request->camera, targets.width, targets.height);
        else
            areas_.clear();
        return {};
    }

    bool altersPicture(const PassFrame& frame) const override
    {
        return frame.hasMedia && !areas_.areas().empty() && frame.settings->shimmer.strength > 0.0f;
    }

    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override
    {
        if (stage != PassStage::Refract || !altersPicture(frame))
            return;
        const ShimmerSettings& settings = frame.settings->shimmer;
        const ResourceId heat =
            HeatOffsetPass::addTo(graph, {frame.blobs, frame.distance, blobs_, true, frame.width,
                                          frame.height, frame.view, settings, frame.request->time})
                .heat;
        frame.picture =
            HeatShimmerPass::addTo(graph, {frame.picture, frame.distance, heat, areas_.areas(), frame.width,
                                           frame.height, frame.request->camera.upperLeftOrigin, settings})
                .color;
    }

private:
    HotAreas areas_;
    uint32_t blobs_ = 0;
};

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<ShimmerView>(setup);
}

std::span<const ProgramDesc* const> programs()
{
    return kPrograms;
}

bool isUsedBy(const EffectContent& content)
{
    return content.bendsLight;
}

double weight(const ScreenShare& covered)
{
    return covered.hot;
}

void lowerShimmer(float isOn, ViewSettings& settings)
{
    if (isOn == 0.0f)
        settings.shimmer.strength = 0.0f;
}

constexpr QualityKnob kKnobs[] = {
    {"shimmer",
     "shimmer",
     QualityKnob::Type::Switch,
     {},
     R"({"title": "Shimmer", "description": "Heat shimmer.", "type": "boolean"})",
     lowerShimmer},
};

constexpr ScalabilitySettings kScalability{"shimmer", "hot air", weight, kKnobs};

} // namespace

constexpr DrawTechnique kShimmerTechnique{
    .name = "heat shimmer",
    .create = create,
    .programs = programs,
    .passes = kPasses,
    .isUsedBy = isUsedBy,
    .levels = &kScalability,
};

} // namespace fx::render
