#include "benchmarks/accuracy/techniques/block_order.h"

#include "benchmarks/accuracy/techniques/cumulus_scenes.h"
#include "benchmarks/scenes/quality_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr uint32_t kPairs = 20;
constexpr uint64_t kSeed = 3;
constexpr double kMost = 1.0 / 1023.0; ///< [1] of the largest exposed value

/// [m] of the eye from the middle: all blocks are small; the nearest ones pass from impostors to balls.
constexpr std::array<double, 2> kDistances{45.0, 12.0};

struct BlockOrderSetting
{
    const char* name;
    render::Composition composition;
    float parallax; ///< see BlockSettings
    float error;    ///< likewise
    bool hasImpostors;
    bool isControl;
};

constexpr std::array<BlockOrderSetting, 4> kSettings{
    {{"impostors", render::Composition::Slabs, render::BlockSettings().parallax,
      render::BlockSettings().error, true, false},
     {"any-error", render::Composition::Slabs, render::BlockSettings().parallax, 0.0f, true, false},
     {"balls", render::Composition::Slabs, 0.0f, 0.0f, false, false},
     {"sorted", render::Composition::Sorted, 0.0f, 0.0f, false, true}}};

struct OrderPictures
{
    std::vector<std::vector<float>> views; ///< RGBA
    double seconds = 0.0;
    uint64_t impostors = 0;
};
using PicturesOfSettings = std::array<OrderPictures, kSettings.size()>;

class BlockOrderAccuracy final : public AccuracyTechnique
{
public:
    explicit BlockOrderAccuracy(const AccuracyScale& scale)
        : width_(scale.width > 0 ? scale.width : 96), height_(scale.width > 0 ? scale.height : 54)
    {
        for (const BlockOrderSetting& setting : kSettings)
            settings_.push_back({setting.name,
                                 "",
                                 {{"pairs", kPairs},
                                  {"width", width_},
                                  {"height", height_},
                                  {"parallax", setting.parallax},
                                  {"block_error", setting.error},
                                  {"control", setting.isControl}}});
    }

    std::string_view scene() const override { return kBlockOrderScene; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t index, const std::function<bool()>& stop) override;

private:
    base::Result<PicturesOfSettings> drawAll(bool isReversed, const std::function<bool()>& stop) const;

    int width_, height_; ///< [pixel]
    std::vector<AccuracySetting> settings_;
    PicturesOfSettings listed_, reversed_; ///< without pictures before the first run
};

base::Status drawView(QualityStage& stage, const BlockOrderSetting& setting, double distance,
                      OrderPictures& io)
{
    render::ViewSettings settings = stage.view().renderer.settings();
    settings.composition = setting.composition;
    settings.blocks.parallax = setting.parallax;
    settings.blocks.error = setting.error;
    stage.view().setSettings(settings);
    scene_file::CameraPath camera;
    camera.fovYDegrees = 30.0f;
    camera.target = {0.0, 27.0, 0.0};
    camera.position = camera.target + distance * glm::dvec3(0.0, 0.0, 1.0);
    if (base::Status status = stage.look(camera); !status)
        return status;
    const render::FrameStatistics& drawn = stage.view().renderer.statistics();
    constexpr int kSettling = 16; // tiles are spread over frames
    for (int k = 0; k < kSettling && (k == 0 || drawn.blockTilesDeferred > 0); ++k)
        if (base::Status status = stage.draw(); !status)
            return status;
    io.views.push_back(stage.picture());
    io.seconds += 1e-3 * stage.processorMilliseconds();
    io.impostors += drawn.blockImpostors;
    return {};
}

base::Result<PicturesOfSettings> BlockOrderAccuracy::drawAll(bool isReversed,
                                                             const std::function<bool()>& stop) const
{
    const auto scene = twinBlocksScene(kPairs, kSeed, isReversed);
    if (!scene.ok())
        return scene.status();
    auto stage = QualityStage::create(*scene, width_, height_);
    if (!stage.ok())
        return stage.status();
    if (base::Status status = (*stage)->simulate(base::toTicks(1.0)); !status)
        return status;
    PicturesOfSettings pictures;
    for (size_t k = 0; k < kSettings.size(); ++k)
        for (const double distance : kDistances) {
            if (stop())
                return base::Status(base::Code::Interrupted, "interrupted");
            if (base::Status status = drawView(**stage, kSettings[k], distance, pictures[k]); !status)
                return status;
        }
    return pictures;
}

base::Result<AccuracySample> BlockOrderAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (listed_.front().views.empty()) {
        auto listed = drawAll(false, stop);
        if (!listed.ok())
            return listed.status();
        auto reversed = drawAll(true, stop);
        if (!reversed.ok())
            return reversed.status();
        listed_ = std::move(*listed);
        reversed_ = std::move(*reversed);
    }
    const BlockOrderSetting& setting = kSettings[index];
    const OrderPictures &a = listed_[index], &b = reversed_[index];
    std::vector<double> errors;
    for (size_t view = 0; view < a.views.size(); ++view) {
        double largest = 0.0; // exposed value
        for (size_t i = 0; i < a.views[view].size(); ++i)
            largest = i % 4 == 3 ? largest : std::max(largest, double(a.views[view][i]));
        for (size_t i = 0; i < a.views[view].size(); ++i)
            if (i % 4 != 3)
                errors.push_back((double(b.views[view][i]) - double(a.views[view][i])) / largest);
    }
    AccuracySample sample;
    storeErrors(std::move(errors), sample);
    sample.seconds = a.seconds + b.seconds;
    sample.items = double(a.views.size() + b.views.size());
    const bool isKept = sample.errorMax <= kMost;
    sample.isAsPromised = isKept != setting.isControl && (a.impostors > 0) == setting.hasImpostors;
    sample.work = {{"bound", kMost},
                   {"kept", isKept},
                   {"impostors_per_view", double(a.impostors) / double(a.views.size())}};
    char note[120];
    std::snprintf(note, sizeof note, "largest %.2g of the largest value, bound %.2g, %.0f impostors%s",
                  sample.errorMax, kMost, double(a.impostors) / double(a.views.size()),
                  setting.isControl ? ", control" : "");
    sample.note = note;
    return sample;
}

} // namespace

std::unique_ptr<AccuracyTechnique> makeBlockOrder(const AccuracyScale& scale)
{
    return std::make_unique<BlockOrderAccuracy>(scale);
}

} // namespace fx::cli
