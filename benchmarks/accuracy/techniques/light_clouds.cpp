#include "benchmarks/accuracy/techniques/light_clouds.h"

#include "benchmarks/scenes/lit_media.h"
#include "fxsdk/cli/support/interrupt.h"

#include <array>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr double kDistance = 6.0; // [m] of the eye; the sun stands at +z

struct CloudView
{
    const char* name;
    glm::dvec3 eye;
};
constexpr std::array<CloudView, 3> kViews{{{"sunward", {0.0, 0.0, kDistance}},
                                           {"side", {kDistance, 0.0, 0.0}},
                                           {"behind", {0.0, 0.0, -kDistance}}}};

std::vector<BallOfMedia> clouds(bool isSmall)
{
    std::vector<BallOfMedia> all;
    for (const double depth : {1.0, 5.0, 15.0})
        for (const double albedo : {0.9, 0.99, 1.0})
            for (const double g : {0.0, 0.7})
                if (!isSmall || (depth > 1.0 && albedo == 0.99))
                    all.push_back({300, 0.25, depth, albedo, g});
    return all;
}

class LightClouds final : public AccuracyTechnique
{
public:
    explicit LightClouds(bool isSmall) : isSmall_(isSmall), clouds_(clouds(isSmall))
    {
        size_.width = size_.height = isSmall ? 24 : 32;
        view_.lighting.sunDirection = {0.0f, 0.0f, 1.0f};
        view_.lighting.sunIlluminance = glm::vec3(1e5f);
        view_.lighting.groundAlbedo = 0.0f;
        for (const BallOfMedia& cloud : clouds_) {
            char name[64];
            std::snprintf(name, sizeof name, "tau %g albedo %g g %g", cloud.depth, cloud.albedo,
                          cloud.anisotropy);
            settings_.push_back({name,
                                 "",
                                 {{"tau", cloud.depth},
                                  {"albedo", cloud.albedo},
                                  {"g", cloud.anisotropy},
                                  {"blobs", cloud.blobs}}});
        }
    }

    std::string_view scene() const override { return isSmall_ ? "clouds-small" : "clouds"; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override
    {
        if (!painter_) {
            auto painter = LitPainter::create(size_.width, size_.height);
            if (!painter.ok())
                return painter.status();
            painter_ = std::move(*painter);
        }
        const std::vector<render::MediumBlob> blobs = blobsOf(clouds_[setting]);
        AccuracySample sample;
        std::vector<double> errors;
        for (const CloudView& from : kViews) {
            view_.eye = from.eye;
            const auto truth = traced(blobs, view_, size_, stop);
            if (!truth.ok())
                return truth.status();
            const auto picture = painter_->paint(blobs, view_, {});
            if (!picture.ok())
                return picture.status();
            const double wanted = meanLight(*truth), got = meanLight(*picture);
            errors.push_back(got / wanted - 1.0);
            sample.work[from.name] = wanted;
            sample.work[std::string(from.name) + "_error"] = errors.back();
            sample.seconds += picture->seconds;
        }
        sample.items = double(kViews.size());
        char note[80];
        std::snprintf(note, sizeof note, "sunward %+.1f %%, side %+.1f %%, behind %+.1f %%", 1e2 * errors[0],
                      1e2 * errors[1], 1e2 * errors[2]);
        sample.note = note;
        storeErrors(errors, sample);
        return sample;
    }

private:
    bool isSmall_;
    std::vector<BallOfMedia> clouds_;
    std::vector<AccuracySetting> settings_;
    LitSize size_;
    LitView view_;
    std::unique_ptr<LitPainter> painter_;
};

} // namespace

std::unique_ptr<AccuracyTechnique> makeLightClouds(bool isSmall)
{
    return std::make_unique<LightClouds>(isSmall);
}

} // namespace fx::cli
