/// @file flights.cpp
/// Whether pictures change from frame to frame as little as the scene does: sequences of frames of a moving
/// eye, moving media or a moving light, drawn by OpenGL, against the same frames by the ray integral.
/// Compositions are compared on media with light of their own; light slices on media in the light of the sun,
/// against its exact single scattering. `sorted`, on balls-orbit, and planes that are not snapped are
/// controls: they have to break the bound that all others have to keep.

#include "benchmarks/scenes/flights.h"
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/frame_changes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace fx::cli {
namespace {

/// Balls below this radius are widened to it, their cross section kept, in all pictures. Sparks are smaller
/// than a pixel: the reference's one ray hits one in a frame and misses it in the next, which is its own
/// flicker.
constexpr double kLeastRadius = 0.75; // [pixel]

struct FlightSetting
{
    const char* name;
    render::Composition composition;
    int slabs = 16;
    int voxels = 96;
    bool isSnapped = true;
    bool isControl = false;
};

const std::vector<FlightSetting>& settingsOf(FlightSubject subject)
{
    using render::Composition;
    static const std::vector<FlightSetting> kCompositions = {
        {"sorted", Composition::Sorted, 16, 96, true, true},
        {"slabs-6", Composition::Slabs, 6},
        {"slabs-16", Composition::Slabs, 16},
        {"volume-64", Composition::Volume, 16, 64},
        {"volume-128", Composition::Volume, 16, 128}};
    static const std::vector<FlightSetting> kSlices = {
        {"slices", Composition::Slabs, 16, 96, true, false},
        {"slices-not-snapped", Composition::Slabs, 16, 96, false, true}};
    return subject == FlightSubject::Light ? kSlices : kCompositions;
}

const FlightName& flightOf(const std::string& scene)
{
    return *std::ranges::find_if(flightNames(),
                                 [&](const FlightName& flight) { return flight.name == scene; });
}

/// Rec. 709.
std::vector<float> luminanceOf(const LitPicture& picture)
{
    std::vector<float> luminance;
    for (const glm::dvec3& light : picture.light)
        luminance.push_back(float(0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z));
    return luminance;
}

void widenSmallBalls(int height, FlightFrame& io)
{
    const double slope = 2.0 * std::tan(0.5 * io.view.fovYDegrees * std::numbers::pi / 180.0) / height;
    for (render::MediumBlob& blob : io.blobs)
        blob.radius = std::max(blob.radius, kLeastRadius * slope * glm::distance(blob.center, io.view.eye));
}

class FlightAccuracy final : public AccuracyTechnique
{
public:
    FlightAccuracy(const std::string& scene, const AccuracyScale& scale)
        : scene_(scene), subject_(flightOf(scene).subject), bound_{scale.bound > 0 ? scale.bound : 1.5, 0.1},
          frames_(scale.frames > 0 ? std::min(scale.frames, flightOf(scene).frames) : flightOf(scene).frames)
    {
        const bool isGiven = scale.width > 0;
        size_.width = isGiven ? scale.width : 96;
        size_.height = isGiven ? scale.height : 54;
        for (const FlightSetting& setting : settingsOf(subject_))
            settings_.push_back({setting.name,
                                 "",
                                 {{"frames", frames_},
                                  {"width", size_.width},
                                  {"height", size_.height},
                                  {"least_radius", kLeastRadius},
                                  {"bound", bound_.factor},
                                  {"control", setting.isControl}}});
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    /// What a setting takes, and how bright its pictures are where the reference has media.
    struct Seen
    {
        double seconds = 0.0;
        double brightness = 0.0;
    };
    base::Status start(const std::function<bool()>& stop);
    void addReference(const LitPicture& picture);
    base::Result<std::vector<double>> changesOf(const FlightSetting& setting,
                                                const std::function<bool()>& stop, Seen& outSeen);

    std::string scene_;
    FlightSubject subject_;
    ChangeBound bound_;
    uint32_t frames_;
    LitSize size_;
    std::vector<AccuracySetting> settings_;
    std::vector<FlightFrame> flight_;
    std::vector<std::vector<bool>> covered_; ///< of each frame
    std::vector<double> reference_;          ///< change of each pair of frames
    std::vector<float> last_;                ///< luminance of the last frame of the reference
    double brightness_ = 0.0;                ///< mean luminance of the reference's covered pixels
    std::unique_ptr<LitPainter> painter_;
};

void FlightAccuracy::addReference(const LitPicture& picture)
{
    constexpr double kCovered = 0.01; // opacity
    std::vector<bool> covered;
    for (const double opacity : picture.opacity)
        covered.push_back(opacity >= kCovered);
    std::vector<float> light = luminanceOf(picture);
    if (!covered_.empty())
        reference_.push_back(meanChange(last_, light, covered_.back(), covered));
    const std::vector<float> black(light.size(), 0.0f);
    brightness_ += meanChange(black, light, covered, covered) / double(flight_.size());
    covered_.push_back(std::move(covered));
    last_ = std::move(light);
}

base::Status FlightAccuracy::start(const std::function<bool()>& stop)
{
    if (painter_)
        return {};
    auto flight = flightFrames(scene_, frames_);
    if (!flight.ok())
        return flight.status();
    flight_ = std::move(*flight);
    for (FlightFrame& frame : flight_) {
        widenSmallBalls(size_.height, frame);
        const auto picture = integrated(frame.blobs, frame.view, size_, stop);
        if (!picture.ok())
            return picture.status();
        addReference(*picture);
    }
    auto painter = LitPainter::create(size_.width, size_.height);
    if (!painter.ok())
        return painter.status();
    painter_ = std::move(*painter);
    return {};
}

base::Result<std::vector<double>> FlightAccuracy::changesOf(const FlightSetting& setting,
                                                            const std::function<bool()>& stop, Seen& outSeen)
{
    render::SliceSettings slices;
    slices.multiple = false;
    slices.snapped = setting.isSnapped;
    painter_->settings().composition = setting.composition;
    painter_->settings().slabs = setting.slabs;
    painter_->settings().voxels = setting.voxels;
    std::vector<double> changes;
    std::vector<float> before;
    for (size_t k = 0; k < flight_.size(); ++k) {
        if (stop())
            return base::Status(base::Code::Interrupted, "interrupted");
        const auto picture = painter_->paint(flight_[k].blobs, flight_[k].view, slices);
        if (!picture.ok())
            return picture.status();
        outSeen.seconds += picture->seconds;
        std::vector<float> light = luminanceOf(*picture);
        const std::vector<float> black(light.size(), 0.0f);
        outSeen.brightness += meanChange(black, light, covered_[k], covered_[k]) / double(flight_.size());
        if (k > 0)
            changes.push_back(meanChange(before, light, covered_[k - 1], covered_[k]));
        before = std::move(light);
    }
    return changes;
}

base::Result<AccuracySample> FlightAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (base::Status status = start(stop); !status)
        return status;
    const FlightSetting& setting = settingsOf(subject_)[index];
    AccuracySample sample;
    Seen seen;
    const auto changes = changesOf(setting, stop, seen);
    if (!changes.ok())
        return changes.status();
    const ChangeJudgment judgment = judgeChanges(*changes, reference_, bound_);
    sample.seconds = seen.seconds;
    storeErrors(judgment.excess, sample);
    sample.items = double(flight_.size());
    const bool needsControl = subject_ == FlightSubject::Light || flightOf(scene_).hasControl;
    sample.isAsPromised = setting.isControl ? !needsControl || !judgment.isKept() : judgment.isKept();
    sample.work = {{"pairs", judgment.excess.size()},
                   {"pairs_beyond", judgment.beyond},
                   {"worst_pair", judgment.worst},
                   {"kept", judgment.isKept()},
                   {"change_ratio", judgment.medianRatio},
                   {"change_reference", judgment.medianReference},
                   {"brightness_ratio", seen.brightness / brightness_},
                   {"blobs", flight_.front().blobs.size()}};
    char note[96];
    std::snprintf(note, sizeof note, "%zu of %zu beyond, worst %.2f at %zu, ratio %.3f, brightness %.3f%s",
                  judgment.beyond, judgment.excess.size(), sample.errorMax, judgment.worst,
                  judgment.medianRatio, seen.brightness / brightness_, setting.isControl ? ", control" : "");
    sample.note = note;
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale& scale)
{
    return std::make_unique<FlightAccuracy>(scene, scale);
}

} // namespace

AccuracyTechniqueEntry flightsAccuracy()
{
    std::vector<std::string> scenes;
    for (const FlightName& flight : flightNames())
        scenes.emplace_back(flight.name);
    const size_t count = scenes.size();
    return {"flights",
            "change from frame to frame of compositions and light slices, against that of the ray integral",
            "frame",
            ShownError::P99,
            std::move(scenes),
            count,
            false,
            make,
            true};
}

} // namespace fx::cli
