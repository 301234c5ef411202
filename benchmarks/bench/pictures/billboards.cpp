// fx bench billboards: the GPU's billboards against the reference renderer: 1, 10 and 270 blobs that stand
// alone, that overlap, and that overlap and are drawn front to back instead of back to front. Prints one JSON
// object a case and form: relative errors of the channels that are brighter than a thousandth of the
// brightest, and the least time of a frame (not of those in wrong order: a view sorts, so that each blob is
// drawn in a frame of its own there).
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/cards.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/techniques.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/reference/render/reference_renderer.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/view/view_renderer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <string>

namespace fx::cli {
namespace {

using Cards = std::vector<Card>;

constexpr float kField = 2.4f;          ///< [m] that the width of the picture shows
constexpr double kExposure = 1.0 / 1.2; ///< of EV 0

struct Options
{
    int width = 480;
    int height = 300;
    int repeat = 5;
    bool isSmall = false;
};

/// Cards stand in front of the eye, their z along the view. No two snapshots have the same number: a view
/// takes what it made from one for another of the same number.
base::FrameSnapshot snapshotOf(const base::SnapshotSchema& schema, std::span<const Card> cards)
{
    namespace column = base::blob_column;
    static uint64_t published = 0;
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(0, ++published);
    auto& group = snapshot.addGroup(schema.find(base::kBlobKind.name), cards.size());
    for (size_t c = 0; c < column::Count; ++c)
        std::fill_n(group.editColumn(c).begin(), cards.size(), 0.0f);
    for (size_t i = 0; i < cards.size(); ++i) {
        const Card& card = cards[i];
        const auto set = [&](size_t c, float value) { group.editColumn(c)[i] = value; };
        set(column::PositionX, card.x);
        set(column::PositionY, card.y);
        set(column::PositionZ, -card.z);
        set(column::Radius, card.radius);
        set(column::CrossSection, card.crossSection);
        for (size_t k = 0; k < 3; ++k)
            set(column::EmissionR + k, card.emission[k]);
        group.editIds()[i] = i;
    }
    group.editInfo().count = uint32_t(cards.size());
    group.editConstants()[base::blob_constant::Layer] = float(uint32_t(base::MediaLayer::Smoke));
    return snapshot;
}

/// RGB of each pixel, rows from the top.
std::vector<double> referencePicture(const base::FrameSnapshot& snapshot, const Options& options)
{
    render::ReferenceScene scene;
    scene.blobs = render::mediumOf({&snapshot, nullptr}, 1.0).blobs;
    scene.opaque.isEmpty = true;
    scene.camera.orthographic = true;
    scene.camera.halfHeight = 0.5 * double(kField) * options.height / options.width;
    scene.camera.nearDistance = 0.0;
    render::ReferenceSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.exposure = kExposure;
    settings.integral.scheme = render::highScheme();
    const auto tasks = base::makeTbbRunner();
    render::ReferenceRenderer renderer;
    if (!renderer.build(scene, settings, *tasks).ok() || !renderer.render(nullptr, {}).ok())
        fail("the reference renderer refuses the scene");
    std::vector<double> picture;
    for (size_t i = 0; i < renderer.pixels(0).size(); ++i)
        for (uint32_t c = 0; c < 3; ++c)
            picture.push_back(double(renderer.pixels(c)[i]));
    return picture;
}

class Drawing
{
public:
    explicit Drawing(const Options& options)
        : options_(options), gl_(taken(render::createEglContext({}))),
          device_(taken(render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource()))),
          color_(taken(
              render::GlTexture::create(*device_, options.width, options.height, GL_RGBA32F, "picture")))
    {
        preset::registerKinds(schema_);
        view_ =
            std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
        view_->settings().dazzle.enabled = false;
        view_->settings().detail = false;
        view_->settings().exposureEv100 = 0.0f;
    }

    const base::SnapshotSchema& schema() const { return schema_; }
    const std::string& name() const { return device_->limits().renderer; }
    void setForm(render::BillboardForm form) { view_->settings().form = form; }

    void clear()
    {
        const float black[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        device_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, black);
        device_->gl.Finish();
    }
    /// Over what is there. @return [ms]
    double draw(const base::FrameSnapshot& snapshot)
    {
        render::FrameRequest request;
        request.camera =
            render::orthographicView({glm::dvec3(0.0), {0.0, 0.0, -1.0}, {0.0f, 1.0f, 0.0f}},
                                     kField * float(options_.height) / float(options_.width),
                                     float(options_.width) / float(options_.height), 0.0f, 10.0f);
        request.targets.color = color_.name();
        request.targets.width = options_.width;
        request.targets.height = options_.height;
        const auto start = std::chrono::steady_clock::now();
        if (const base::Status status = view_->render({&snapshot, nullptr}, request); !status)
            fail(status.message());
        device_->gl.Finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    /// As referencePicture() gives it.
    std::vector<double> read()
    {
        const std::vector<float> texels =
            render::readTexture(*device_, color_.name(), options_.width, options_.height, 3);
        const size_t row = size_t(options_.width) * 3;
        std::vector<double> picture;
        for (size_t y = size_t(options_.height); y-- > 0;)
            picture.insert(picture.end(), texels.begin() + std::ptrdiff_t(y * row),
                           texels.begin() + std::ptrdiff_t((y + 1) * row));
        return picture;
    }

private:
    Options options_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_;
    render::GlTexture color_;
    base::SnapshotSchema schema_;
    std::unique_ptr<render::ViewRenderer> view_;
};

struct Case
{
    std::string name;
    Cards cards;
    bool isSortedWrong = false;
};

std::vector<Case> allCases()
{
    std::vector<Case> cases;
    for (const uint32_t count : {1u, 10u, 270u})
        cases.push_back({"isolated-" + std::to_string(count), isolatedCards(count)});
    for (const bool isWrong : {false, true})
        for (const uint32_t count : {10u, 270u})
            cases.push_back({(isWrong ? "sorted-wrong-" : "overlapping-") + std::to_string(count),
                             overlappingCards(count), isWrong});
    return cases;
}

/// @return [ms] least time of a frame, or 0 for those in wrong order
double drawCase(Drawing& drawing, const Case& scene, int repeat)
{
    if (!scene.isSortedWrong) {
        double least = 1e30;
        for (int i = 0; i < repeat; ++i) { // each frame shows a new step, as that of a game does
            const base::FrameSnapshot snapshot = snapshotOf(drawing.schema(), scene.cards);
            drawing.clear();
            least = std::min(least, drawing.draw(snapshot));
        }
        return least;
    }
    Cards cards = scene.cards;
    std::stable_sort(cards.begin(), cards.end(), [](const Card& a, const Card& b) { return a.z < b.z; });
    drawing.clear();
    for (const Card& card : cards)
        drawing.draw(snapshotOf(drawing.schema(), {&card, 1}));
    return 0.0;
}

AccuracySample errorsOf(const std::vector<double>& drawn, const std::vector<double>& reference)
{
    const double brightest = *std::max_element(reference.begin(), reference.end());
    std::vector<double> errors;
    for (size_t i = 0; i < reference.size(); ++i)
        if (reference[i] > 1e-3 * brightest)
            errors.push_back(drawn[i] / reference[i] - 1.0);
    AccuracySample sample;
    storeErrors(std::move(errors), sample);
    return sample;
}

void measure(Options options)
{
    if (options.isSmall)
        options.width = 240, options.height = 150, options.repeat = 1;
    Drawing drawing(options);
    Machine machine = readMachine();
    machine.glRenderer = drawing.name();
    constexpr std::pair<const char*, render::BillboardForm> kForms[] = {
        {"kernel", render::BillboardForm::Kernel},
        {"planar", render::BillboardForm::Planar},
        {"constant", render::BillboardForm::Constant}};
    bool asStated = true;
    for (const Case& scene : allCases()) {
        const std::vector<double> reference =
            referencePicture(snapshotOf(drawing.schema(), scene.cards), options);
        for (const auto& [form, value] : kForms) {
            drawing.setForm(value);
            const double milliseconds = drawCase(drawing, scene, options.repeat);
            const AccuracySample sample = errorsOf(drawing.read(), reference);
            nlohmann::json line = {{"name", "billboards_gl"},
                                   {"scene", scene.name},
                                   {"variant", form},
                                   {"blobs", scene.cards.size()},
                                   {"width", options.width},
                                   {"height", options.height},
                                   {"error_p50", sample.errorP50},
                                   {"error_p99", sample.errorP99},
                                   {"error_max", sample.errorMax},
                                   {"bias", sample.bias}};
            if (milliseconds > 0.0)
                line["ms_frame"] = milliseconds;
            printJsonLine(withMachine(line, machine));
            asStated = asStated && (value != render::BillboardForm::Kernel ||
                                    scene.name.rfind("isolated", 0) != 0 || sample.errorP99 < 1e-3);
        }
    }
    if (!asStated)
        fail("a blob that stands alone must be what the reference shows");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    addSizeOption(command, options->width, options->height);
    command.add_option("--repeat", options->repeat, "Frames of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement billboardsBench()
{
    return {"billboards",
            "Errors of the GPU's billboards against the reference renderer, and the time of a frame",
            addOptions};
}

} // namespace fx::cli
