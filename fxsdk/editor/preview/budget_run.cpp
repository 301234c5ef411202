#include "fxsdk/editor/preview/budget_run.h"

#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_unpack_scope.h"

#include <algorithm>
#include <array>

namespace fx::editor {

namespace {

constexpr size_t kMoments = 24;
constexpr int kSmallWidth = 240; // [pixel] of the pictures of the qualities

struct Level
{
    const char* name;
    PreviewQuality quality;
};
constexpr std::array<Level, 3> kLevels{
    {{"low", PreviewQuality::Low}, {"medium", PreviewQuality::Medium}, {"high", PreviewQuality::High}}};

double drawingOf(const StageTimes& times)
{
    return times.lights + times.effects;
}

} // namespace

base::Result<std::unique_ptr<BudgetRun>> BudgetRun::create(const render::GlLoader& loader,
                                                           BudgetSubject subject)
{
    auto preview = Preview::create(loader);
    if (!preview)
        return preview.status();
    return std::unique_ptr<BudgetRun>(new BudgetRun(std::move(*preview), std::move(subject)));
}

BudgetRun::BudgetRun(std::unique_ptr<Preview> preview, BudgetSubject subject)
    : device_(preview->sharedDevice()), preview_(std::move(preview)), subject_(std::move(subject)),
      pieces_((subject_.elements.empty() ? 0 : 1 + subject_.elements.size()) + kLevels.size() + kMoments)
{
    preview_->setMotion(subject_.motion);
    report_.time = subject_.time;
    report_.width = subject_.frame.width;
    report_.height = subject_.frame.height;
}

BudgetRun::~BudgetRun()
{
    for (const QualityCost& quality : report_.qualities)
        device_->gl.DeleteTextures(1, &quality.texture);
}

base::Status BudgetRun::step()
{
    if (isDone())
        return {};
    const base::Status status = measure(next_);
    next_ = status.ok() ? next_ + 1 : pieces_;
    if (isDone())
        preview_.reset();
    return status;
}

base::Status BudgetRun::measure(size_t piece)
{
    const size_t elements = subject_.elements.empty() ? 0 : 1 + subject_.elements.size();
    if (piece < kLevels.size())
        return measureQuality(piece);
    piece -= kLevels.size();
    return piece < elements ? measureElement(piece) : measureMoment(piece - elements);
}

/// The first piece draws no element, the others one each.
base::Status BudgetRun::measureElement(size_t piece)
{
    preview_->setSimulationQuality(FX_QUALITY_DEFAULT);
    StageTimes times;
    uint32_t particles = 0;
    const std::string& text = piece == 0 ? subject_.empty : subject_.elements[piece - 1].second;
    const base::Status status = measureText(text, subject_.time, subject_.frame, times, particles);
    if (piece == 0)
        without_ = drawingOf(times);
    else
        report_.elements.push_back(
            {subject_.elements[piece - 1].first, std::max(drawingOf(times) - without_, 0.0)});
    return status;
}

base::Status BudgetRun::measureText(const std::string& text, double time, const PreviewFrame& frame,
                                    StageTimes& outTimes, uint32_t& outParticles)
{
    base::Status status = preview_->show(text, subject_.name, subject_.kind);
    if (status.ok())
        status = preview_->seek(time);
    outParticles = preview_->particles();
    return status.ok() ? preview_->measure(frame, outTimes) : status;
}

base::Status BudgetRun::measureQuality(size_t level)
{
    QualityCost cost;
    cost.name = kLevels[level].name;
    PreviewFrame frame = subject_.frame;
    frame.quality = kLevels[level].quality;
    preview_->setSimulationQuality(frame.quality == PreviewQuality::Low ? FX_QUALITY_LOW
                                                                        : FX_QUALITY_DEFAULT);
    base::Status status = measureText(subject_.text, subject_.time, frame, cost.times, cost.particles);
    frame.height = std::max(frame.height * kSmallWidth / std::max(frame.width, 1), 8);
    frame.width = kSmallWidth;
    if (status.ok())
        status = preview_->seek(subject_.time);
    if (status.ok())
        status = preview_->render(frame);
    if (!status.ok())
        return status;
    const std::vector<float> pixels =
        render::readTexture(preview_->device(), preview_->texture(), frame.width, frame.height, 3);
    const render::GlFunctions& gl = preview_->device().gl;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &cost.texture);
    gl.TextureStorage2D(cost.texture, 1, GL_RGBA8, frame.width, frame.height);
    gl.TextureParameteri(cost.texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    const render::GlUnpackScope unpack(gl);
    gl.TextureSubImage2D(cost.texture, 0, 0, 0, frame.width, frame.height, GL_RGB, GL_FLOAT, pixels.data());
    report_.qualities.push_back(std::move(cost));
    return {};
}

base::Status BudgetRun::measureMoment(size_t moment)
{
    if (moment == 0) {
        preview_->setSimulationQuality(FX_QUALITY_DEFAULT);
        if (base::Status status = preview_->show(subject_.text, subject_.name, subject_.kind); !status)
            return status;
    }
    MomentCost cost;
    cost.time = subject_.end * double(moment) / double(kMoments - 1);
    if (base::Status status = preview_->seek(cost.time); !status)
        return status;
    cost.particles = preview_->particles();
    const base::Status status = preview_->measureStep(cost.simulation);
    report_.moments.push_back(cost);
    return status;
}

} // namespace fx::editor
