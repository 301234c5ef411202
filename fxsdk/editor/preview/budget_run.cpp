#include "fxsdk/editor/preview/budget_run.h"

#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_unpack_scope.h"

#include <algorithm>
#include <array>
#include <cmath>

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
    : device_(preview->sharedDevice()), preview_(std::move(preview)), subject_(std::move(subject)), pieces_(0)
{
    if (subject_.elements.size() > kMostElements) {
        report_.unmeasured = subject_.elements.size() - kMostElements;
        subject_.elements.resize(kMostElements);
    }
    pieces_ = kLevels.size() + partPieces() + kMoments;
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
    if (piece < kLevels.size())
        return measureQuality(piece);
    piece -= kLevels.size();
    return piece < partPieces() ? measurePart(piece) : measureMoment(piece - partPieces());
}

/// No element, all of them, each one, all without each technique, and all again.
size_t BudgetRun::partPieces() const
{
    return subject_.elements.empty() ? 0 : 3 + subject_.elements.size() + subject_.techniques.size();
}

base::Status BudgetRun::measurePart(size_t piece)
{
    preview_->setSimulationQuality(FX_QUALITY_DEFAULT);
    const size_t elements = subject_.elements.size(), techniques = subject_.techniques.size();
    if (piece == 0)
        return measureText(subject_.empty, subject_.frame, none_);
    if (piece == 1)
        return measureText(subject_.text, subject_.frame, all_);
    piece -= 2;
    Sample sample;
    const bool isElement = piece < elements, isTechnique = !isElement && piece - elements < techniques;
    if (!isElement && !isTechnique) {
        const base::Status status = measureText(subject_.text, subject_.frame, sample);
        addDrift(sample);
        return status;
    }
    const auto& [pointer, text] =
        isElement ? subject_.elements[piece] : subject_.techniques[piece - elements];
    const base::Status status = measureText(text, subject_.frame, sample);
    if (status.ok() && isElement)
        report_.elements.push_back(costOf(pointer, sample, none_));
    else if (status.ok())
        report_.techniques.push_back(costOf(pointer, all_, sample));
    return status;
}

PartCost BudgetRun::costOf(const std::string& pointer, const Sample& with, const Sample& without)
{
    PartCost cost{pointer, {}, with.range + without.range};
    for (double StageTimes::*member : {&StageTimes::simulation, &StageTimes::lights, &StageTimes::effects})
        cost.times.*member = std::max(with.times.*member - without.times.*member, 0.0);
    return cost;
}

/// The machine may have become slower or faster meanwhile.
void BudgetRun::addDrift(const Sample& all)
{
    const auto sumOf = [](const StageTimes& times) {
        return times.simulation + times.lights + times.effects;
    };
    const double drift = std::abs(sumOf(all.times) - sumOf(all_.times));
    for (std::vector<PartCost>* const parts : {&report_.elements, &report_.techniques})
        for (PartCost& part : *parts)
            part.noise += drift;
}

base::Status BudgetRun::measureText(const std::string& text, const PreviewFrame& frame, Sample& out)
{
    base::Status status = preview_->show(text, subject_.name, subject_.kind);
    if (status.ok())
        status = preview_->seek(subject_.time);
    out.particles = preview_->particles();
    return status.ok() ? preview_->measure(frame, out.times, &out.range) : status;
}

base::Status BudgetRun::measureQuality(size_t level)
{
    QualityCost cost;
    cost.name = kLevels[level].name;
    PreviewFrame frame = subject_.frame;
    frame.quality = kLevels[level].quality;
    preview_->setSimulationQuality(frame.quality == PreviewQuality::Low ? FX_QUALITY_LOW
                                                                        : FX_QUALITY_DEFAULT);
    Sample sample;
    base::Status status = measureText(subject_.text, frame, sample);
    cost.times = sample.times;
    cost.particles = sample.particles;
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
