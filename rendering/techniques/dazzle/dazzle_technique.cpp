#include "rendering/techniques/draw_techniques.h"

#include "rendering/gl/gl_buffer.h"
#include "rendering/passes/dazzle_pass.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr TimedPass kPasses[] = {
    {"dazzle sum", "dazzle"}, {"dazzle budget", "dazzle"}, {"dazzle deal", "dazzle"}};

constexpr const ProgramDesc* kPrograms[] = {&kDazzleSumProgram, &kDazzleBudgetProgram, &kDazzleDealProgram};

/// The adaptation of one view.
class DazzleView final : public TechniqueView
{
public:
    explicit DazzleView(const TechniqueSetup& setup) : device_(*setup.device) {}

    base::Status prepare() override
    {
        if (history_.name() != 0)
            return {};
        auto created = GlBuffer::create(device_, sizeof(DazzleHistory), "dazzle history");
        if (!created)
            return created.status();
        history_ = std::move(*created);
        isFresh_ = true;
        return {};
    }

    base::Status begin(const ViewSettings& settings) override
    {
        hasRun_ = false;
        return settings.dazzle.enabled ? prepare() : base::Status();
    }

    bool altersPicture(const PassFrame& frame) const override { return frame.settings->dazzle.enabled; }

    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override
    {
        if (stage != PassStage::Sensor || !frame.settings->dazzle.enabled)
            return;
        const ResourceId history =
            graph.importBuffer({"dazzle history", sizeof(DazzleHistory)}, history_.name());
        const auto dazzled = DazzlePass::addTo(graph, {frame.picture, history, frame.width, frame.height,
                                                       frame.settings->dazzle, frame.request->deltaTime,
                                                       frame.request->resetHistory || isFresh_});
        frame.picture = dazzled.color;
        graph.keep(dazzled.history);
        hasRun_ = true;
        frame.anyPass = true;
    }

    void endFrame(bool succeeded) override { isFresh_ = !(succeeded && hasRun_); }
    void rest() override { isFresh_ = true; }

    void readBack(const GlBackend&, FrameStatistics& statistics) override
    {
        if (history_.name() == 0 || isFresh_)
            return;
        DazzleHistory history;
        device_.gl.GetNamedBufferSubData(history_.name(), 0, sizeof history, &history);
        std::copy_n(history.frameMean, 3, statistics.overflow);
    }

private:
    GlDevice& device_;
    GlBuffer history_;
    bool isFresh_ = false; ///< the history holds no frame, or frames without dazzle came since
    bool hasRun_ = false;  ///< in this frame
};

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<DazzleView>(setup);
}

std::span<const ProgramDesc* const> programs()
{
    return kPrograms;
}

base::Status check(const ViewSettings& settings)
{
    return checkSensorLaw(settings.dazzle);
}

bool actsAlone(const ViewSettings& settings)
{
    return settings.dazzle.enabled;
}

/// Whatever is drawn may saturate the sensor.
bool isUsedBy(const EffectContent& content)
{
    return content.isDrawn;
}

/// Glare is about as large as what is bright.
double weight(const ScreenShare& covered)
{
    return covered.media;
}

void lowerDazzle(float isOn, ViewSettings& settings)
{
    settings.dazzle.enabled = settings.dazzle.enabled && isOn != 0.0f;
}

constexpr QualityKnob kKnobs[] = {
    {"dazzle",
     "dazzle",
     QualityKnob::Type::Switch,
     {},
     R"({"title": "Dazzle", "description": "Glare.", "type": "boolean"})",
     lowerDazzle},
};

constexpr ScalabilitySettings kScalability{"dazzle", "glare", weight, kKnobs};

} // namespace

constexpr DrawTechnique kDazzleTechnique{
    .name = "dazzle",
    .create = create,
    .programs = programs,
    .passes = kPasses,
    .isUsedBy = isUsedBy,
    .check = check,
    .actsAlone = actsAlone,
    .levels = &kScalability,
};

} // namespace fx::render
