/// @file light_slices.cpp
/// Transmittance between a light and points within a cloud, as light slices give it, against shadow rays:
/// planes at fixed places, planes between the first and last depth of the medium, Fourier coefficients, and
/// the planes and texels that a view uses.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/slice_forms.h"
#include "rendering/lights/slices/slice_depths.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory_resource>
#include <tuple>

namespace fx::cli {
namespace {

using render::SliceResolution;
using render::SliceStack;

constexpr uint32_t kBlobs = 270;
constexpr uint32_t kPoints = 1500;
constexpr uint32_t kTimedColumns = 64;
constexpr int kFineTexels = 8; ///< of which as many lie side by side as two planes are apart

struct SliceSetting
{
    SliceForm form;
    int texels = 0; ///< 0: so fine that they have no part in the error
};

enum class Light
{
    Parallel,
    Outside,
    Inside
};

SliceStack stackOf(Light light, std::span<const render::MediumCaster> casters, const SliceResolution& size)
{
    SliceStack stack;
    if (light == Light::Parallel)
        render::fitParallelSlices(glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f)), casters, glm::dvec3(0.0), size,
                                  stack);
    else
        render::fitPointSlices(light == Light::Outside ? glm::vec3(1.5f, 1.2f, 0.9f)
                                                       : glm::vec3(0.2f, 0.1f, -0.3f),
                               0.0f, casters, size, stack);
    return stack;
}

/// The same planes with texels of any size.
SliceStack withTexels(SliceStack stack, int inASpacing)
{
    if (stack.mapping == render::SliceMapping::Parallel)
        stack.texel = stack.spacing / float(inASpacing);
    else // the farthest texels are the largest: some 4 / texels of the distance
        stack.resolution.texels = 4 * inASpacing * (stack.resolution.planes - 1);
    return stack;
}

/// Order of errors that fall with the number of planes: slope of a line through the logarithms.
double fittedOrder(const std::vector<double>& planes, const std::vector<double>& errors)
{
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < planes.size(); ++i) {
        const double x = -std::log(planes[i]), y = std::log(errors[i]);
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

class LightSlicesAccuracy final : public CountedAccuracy
{
public:
    LightSlicesAccuracy(const std::string& scene, Light light, double depth)
        : scene_(scene), light_(light), casters_(lightCloud(kBlobs, depth)),
          points_(pointsWithin(casters_, kPoints))
    {
        const auto add = [&](const std::string& name, const char* tier, SliceSetting setting,
                             nlohmann::json own) {
            own["light"] = scene.substr(0, scene.find("-tau"));
            own["tau"] = depth;
            own["blobs"] = kBlobs;
            forms_.push_back(setting);
            settings_.push_back({name, tier, own});
        };
        for (const int planes : {32, 4, 8, 16, 64, 128})
            add("planes-" + std::to_string(planes), "", {{SliceForm::Kind::Planes, planes}, 0},
                {{"planes", planes}});
        for (const int planes : {4, 8, 16, 32})
            add("deep-" + std::to_string(planes), "", {{SliceForm::Kind::Deep, planes}, 0},
                {{"planes", planes}});
        for (const int values : {7, 15})
            add("fourier-" + std::to_string(values), "", {{SliceForm::Kind::Fourier, values}, 0},
                {{"coefficients", values}});
        const int part = light == Light::Parallel ? 1 : 2; // as LightList gives lights at points
        for (const auto& [texels, planes, tier] :
             {std::tuple(64, 16, "low"), std::tuple(128, 32, "default"), std::tuple(256, 64, "high")})
            add("view-" + std::to_string(texels) + "-" + std::to_string(planes), tier,
                {{SliceForm::Kind::Planes, planes / part}, texels / part},
                {{"planes", planes / part}, {"texels", texels / part}});
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    std::optional<MeasuredWork> work(size_t setting) override
    {
        const SliceSetting& s = forms_[setting];
        if (s.texels > 0) {
            const SliceStack stack = stackOf(light_, casters_, {s.texels, s.form.values});
            items_ = double(s.texels) * double(s.texels);
            return measureWork([&] { depths_.build(stack, casters_); });
        }
        const SliceStack stack = withTexels(stackOf(light_, casters_, placesOf(s.form)), fineTexels(s.form));
        items_ = kTimedColumns;
        return measureWork([&] {
            for (uint32_t i = 0; i < kTimedColumns; ++i) {
                const render::SlicePlace place = stack.placeOf(points_[i]);
                (void)makeColumn(s.form, stack, render::sliceRay(stack, place.x, place.y), casters_);
            }
        });
    }

protected:
    double items() const override { return items_; }

    void judge(size_t setting, AccuracySample& outSample) override
    {
        const SliceSetting& s = forms_[setting];
        if (s.texels > 0) {
            std::vector<double> errors;
            for (size_t i = 0; i < points_.size(); ++i)
                errors.push_back(std::exp(-double(depths_.depthAt(points_[i]).toLight)) - exactly()[i]);
            storeErrors(errors, outSample);
            outSample.work = {{"values_per_texel", s.form.values}};
            return;
        }
        const int fine = fineTexels(s.form);
        AccuracySample finer;
        storeErrors(errorsOf(s.form, fine), outSample);
        storeErrors(errorsOf(s.form, 2 * fine), finer);
        outSample.work = {{"values_per_texel", s.form.values},
                          {"change_with_half_texels", std::abs(finer.errorMean / outSample.errorMean - 1.0)}};
        if (setting == 0)
            storeOrders(outSample);
    }

private:
    /// Deep planes lie closer to each other than those of the stack.
    static int fineTexels(const SliceForm& form)
    {
        return form.kind == SliceForm::Kind::Deep ? 2 * kFineTexels : kFineTexels;
    }

    /// The planes of a stack of which a form takes the places.
    static SliceResolution placesOf(const SliceForm& form)
    {
        return {8, form.kind == SliceForm::Kind::Planes ? form.values : 32};
    }

    const std::vector<double>& exactly()
    {
        if (exact_.empty()) {
            const render::BlobMedium medium = mediumOf(casters_);
            const SliceStack stack = stackOf(light_, casters_, {8, 32});
            for (const glm::vec3& point : points_)
                exact_.push_back(std::exp(-shadowRayDepth(medium, stack, point)));
        }
        return exact_;
    }

    std::vector<double> errorsOf(const SliceForm& form, int texelsInASpacing)
    {
        SliceField field(form, withTexels(stackOf(light_, casters_, placesOf(form)), texelsInASpacing),
                         casters_);
        std::vector<double> errors;
        for (size_t i = 0; i < points_.size(); ++i)
            errors.push_back(std::exp(-field.depthAt(points_[i])) - exactly()[i]);
        return errors;
    }

    void storeOrders(AccuracySample& outSample)
    {
        std::vector<double> counts, means, largest;
        for (const int planes : {4, 8, 16, 32, 64, 128}) {
            AccuracySample sample;
            storeErrors(errorsOf({SliceForm::Kind::Planes, planes}, kFineTexels), sample);
            counts.push_back(planes);
            means.push_back(sample.errorMean);
            largest.push_back(sample.errorMax);
        }
        outSample.work["order_mean"] = fittedOrder(counts, means);
        outSample.work["order_max"] = fittedOrder(counts, largest);
    }

    std::string scene_;
    Light light_;
    std::vector<render::MediumCaster> casters_;
    std::vector<glm::vec3> points_;
    std::vector<AccuracySetting> settings_;
    std::vector<SliceSetting> forms_;
    render::SliceDepths depths_{std::pmr::new_delete_resource()};
    std::vector<double> exact_; ///< transmittance at points_; made when it is needed
    double items_ = 0;
};

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    const Light light = scene.rfind("parallel", 0) == 0  ? Light::Parallel
                        : scene.rfind("outside", 0) == 0 ? Light::Outside
                                                         : Light::Inside;
    return std::make_unique<LightSlicesAccuracy>(scene, light,
                                                 std::atof(scene.c_str() + scene.rfind('-') + 1));
}

} // namespace

AccuracyTechniqueEntry lightSlicesAccuracy()
{
    return {"light-slices",
            "transmittance to a light, planes and other forms against shadow rays",
            "texel",
            ShownError::Mean,
            {"parallel-tau-1", "parallel-tau-10", "outside-tau-1", "outside-tau-10", "inside-tau-1",
             "inside-tau-10"},
            6,
            false,
            make};
}

} // namespace fx::cli
