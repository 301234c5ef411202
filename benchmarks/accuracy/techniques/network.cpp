/// @file network.cpp
/// Light scattered many times in a cloud of lumps: illumination networks of cells and of particles, the
/// closed form and single scattering against paths, and the time in which paths have the same error.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/lumpy_cloud.h"
#include "fxsdk/cli/support/interrupt.h"
#include "rendering/field/network_choice.h"
#include "rendering/network/network_gather.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace fx::cli {
namespace {

/// Size of a picture, and rays through it.
struct RaySize
{
    int size;       ///< [pixel]
    int across;     ///< number of rays of a pixel along each axis
    double step;    ///< [cell] of the fine grid
    uint32_t paths; ///< of a pixel of each reference
};
constexpr RaySize kSmallPicture{16, 2, 1.2, 64}, kPicture{32, 2, 1.2, 64}, kLargePicture{256, 1, 1.2, 8};
constexpr int kFrames = 10;      // of a cloud that moves
constexpr double kGrowth = 0.02; // of the lumps' distances in a frame

struct CloudScene
{
    const char* name;
    CloudLight light;
    double depth;
    double albedos[2] = {0.9, 0.99};
};
constexpr std::array<CloudScene, 16> kScenes{{{"front-5", CloudLight::Front, 5.0},
                                              {"side-5", CloudLight::Side, 5.0},
                                              {"back-5", CloudLight::Back, 5.0},
                                              {"inside-5", CloudLight::Inside, 5.0},
                                              {"front-20", CloudLight::Front, 20.0},
                                              {"side-20", CloudLight::Side, 20.0},
                                              {"back-20", CloudLight::Back, 20.0},
                                              {"inside-20", CloudLight::Inside, 20.0},
                                              {"side-0.5", CloudLight::Side, 0.5},
                                              {"side-1", CloudLight::Side, 1.0},
                                              {"side-2", CloudLight::Side, 2.0},
                                              {"side-5-gray", CloudLight::Side, 5.0, {0.5, 0.7}},
                                              {"side-5-dark", CloudLight::Side, 5.0, {0.15, 0.3}},
                                              {"side-5-large", CloudLight::Side, 5.0},
                                              {"side-20-large", CloudLight::Side, 20.0},
                                              {"side-5-small", CloudLight::Side, 5.0}}};

enum class Form
{
    Single,
    Closed,
    Network,
    Particles,
    Moving ///< a network that sweeps so often in each frame of a cloud that grows
};

struct NetworkForm
{
    const char* name;
    const char* tier;
    Form form;
    int cells, directions, moments; ///< of particles: lines across a bundle instead of cells, and no moments
    int sweeps;                     ///< 0: to rest
    double segment = 0.0;           ///< of particles, see ParticleNetworkSettings
};
constexpr std::array<NetworkForm, 18> kForms{
    {{"single", "", Form::Single, 0, 0, 0, 0},
     {"closed-form", "", Form::Closed, 0, 0, 0, 0},
     {"network-32-6-4", "", Form::Network, 32, 6, 4, 0},
     {"network-32-14-4", "low", Form::Network, 32, 14, 4, 0},
     {"network-32-26-4", "", Form::Network, 32, 26, 4, 0},
     {"network-32-14-9", "", Form::Network, 32, 14, 9, 0},
     {"network-24-26-9", "", Form::Network, 24, 26, 9, 0},
     {"network-32-26-9", "default", Form::Network, 32, 26, 9, 0},
     {"network-48-26-9", "high", Form::Network, 48, 26, 9, 0},
     {"cold-2-sweeps", "", Form::Network, 32, 26, 9, 2},
     {"cold-5-sweeps", "", Form::Network, 32, 26, 9, 5},
     {"cold-10-sweeps", "", Form::Network, 32, 26, 9, 10},
     {"particles-64", "", Form::Particles, 48, 64, 0, 0},
     {"particles-64-segments", "", Form::Particles, 48, 64, 0, 0, 0.5},
     {"particles-128-segments", "", Form::Particles, 48, 128, 0, 0, 0.5},
     {"moving-1-sweep", "", Form::Moving, 32, 26, 9, 1},
     {"moving-2-sweeps", "", Form::Moving, 32, 26, 9, 2},
     {"moving-3-sweeps", "", Form::Moving, 32, 26, 9, 3}}};

/// A piece of a ray with medium.
struct Piece
{
    float at;                    ///< [m] of its middle from the eye
    float depth;                 ///< [1]
    float lightDepth, lineDepth; ///< see CloudPoint
};

struct EyeRay
{
    glm::dvec3 eye, direction;
    size_t begin, end; ///< range of its pieces, from the eye on

    glm::dvec3 place(const Piece& piece) const { return eye + double(piece.at) * direction; }
};

struct EyeRays
{
    const LumpyCloud* cloud = nullptr;
    std::vector<EyeRay> rays;
    std::vector<Piece> pieces;

    std::span<const Piece> of(const EyeRay& ray) const
    {
        return std::span(pieces).subspan(ray.begin, ray.end - ray.begin);
    }
    bool isParallel() const { return cloud->light() != CloudLight::Inside; } ///< light of the sun
};

/// Distances between which a ray is in the box of the cloud.
std::pair<double, double> withinBox(const glm::dvec3& eye, const glm::dvec3& direction)
{
    double first = 0.0, last = 1e30;
    for (int a = 0; a < 3; ++a) {
        const double low = (-kCloudHalf - eye[a]) / direction[a], high = (kCloudHalf - eye[a]) / direction[a];
        if (direction[a] == 0.0 && std::abs(eye[a]) > kCloudHalf)
            return {0.0, 0.0};
        if (direction[a] != 0.0) {
            first = std::max(first, std::min(low, high));
            last = std::min(last, std::max(low, high));
        }
    }
    return {first, last};
}

EyeRays raysThrough(const LumpyCloud& cloud, const RaySize& size)
{
    const render::ReferenceCamera camera = cloud.camera();
    const render::RayGrid grid = camera.grid(size.size, size.size);
    const double step = size.step * cloud.grid().side;
    EyeRays rays{&cloud, {}, {}};
    for (int y = 0; y < size.size * size.across; ++y)
        for (int x = 0; x < size.size * size.across; ++x) {
            const render::TraceRay ray = grid.ray((x + 0.5) / size.across, (y + 0.5) / size.across);
            EyeRay eye{camera.eye + ray.origin, ray.direction, rays.pieces.size(), 0};
            const auto [first, last] = withinBox(eye.eye, eye.direction);
            for (double at = first + 0.5 * step; at < last; at += step) {
                const CloudPoint point = cloud.at(eye.eye + at * eye.direction);
                if (point.extinction > 0.0f)
                    rays.pieces.push_back(
                        {float(at), float(step) * point.extinction, point.lightDepth, point.lineDepth});
            }
            eye.end = rays.pieces.size();
            rays.rays.push_back(eye);
        }
    return rays;
}

/// Means of the rays of each pixel. @param light(ray) its radiance
template <class Light>
std::vector<double> pictureOf(const EyeRays& rays, const RaySize& size, Light&& light)
{
    std::vector<double> picture(size_t(size.size) * size_t(size.size), 0.0);
    const size_t of = size_t(size.across);
    for (size_t i = 0; i < rays.rays.size(); ++i) {
        const size_t across = size_t(size.size) * of, x = i % across / of, y = i / across / of;
        picture[y * size_t(size.size) + x] += light(rays.rays[i]) / double(of * of);
    }
    return picture;
}

double withoutNetwork(const EyeRays& rays, const EyeRay& ray, double albedo, double g, bool isSingle)
{
    double light = 0.0, transmittance = 1.0;
    for (const Piece& p : rays.of(ray)) {
        glm::dvec3 travel;
        const double irradiance = rays.cloud->irradiance(ray.place(p), travel);
        const double cosine = -glm::dot(travel, ray.direction), t = double(p.lightDepth);
        const double scattered = isSingle
                                     ? albedo * formula64::fxHenyeyGreenstein(cosine, g) * std::exp(-t)
                                     : formula64::fxScatteredLight(albedo, g, cosine, t, double(p.lineDepth));
        const double passed = transmittance * std::exp(-double(p.depth));
        light += (transmittance - passed) * scattered * irradiance;
        transmittance = passed;
    }
    return light;
}

/// @param light scattered again, of balls
double withParticles(const EyeRays& rays, const EyeRay& ray, double albedo, double g, const BallLight& light)
{
    double sum = withoutNetwork(rays, ray, albedo, g, true), transmittance = 1.0;
    for (const Piece& p : rays.of(ray)) {
        const double passed = transmittance * std::exp(-double(p.depth));
        sum += (transmittance - passed) * light.at(ray.place(p));
        transmittance = passed;
    }
    return sum;
}

double withNetwork(const EyeRays& rays, const EyeRay& ray, double albedo, const render::NetworkPhase& phase,
                   const render::GatherMoments& moments)
{
    if (ray.begin == ray.end)
        return 0.0;
    const auto angleAt = [&](const glm::dvec3& place, double& outIrradiance) {
        glm::dvec3 travel;
        outIrradiance = rays.cloud->irradiance(place, travel);
        return render::GatherAngle(phase, -glm::dot(travel, ray.direction));
    };
    const auto weights = moments.weights(-ray.direction);
    const double share = phase.extinctionShare(albedo);
    double irradiance, light = 0.0, transmittance = 1.0, scaled = 1.0, depth = 0.0;
    render::GatherAngle angle = angleAt(glm::dvec3(0.0), irradiance);
    for (const Piece& p : rays.of(ray)) {
        const glm::dvec3 place = ray.place(p);
        const double here = double(p.depth);
        if (!rays.isParallel())
            angle = angleAt(place, irradiance);
        const render::GatheredLight first =
            render::gatherUnscattered(angle, {albedo, double(p.lightDepth), depth + 0.5 * here, irradiance});
        const double more = albedo * moments.at(place, weights);
        const double passed = transmittance * std::exp(-here), less = scaled * std::exp(-share * here);
        light += (transmittance - passed) * first.plain + (scaled - less) / share * (first.scaled + more);
        transmittance = passed;
        scaled = less;
        depth += here;
    }
    return light;
}

/// A network's light, and what it cost.
struct Solved
{
    render::NetworkPhase phase;
    render::NetworkState state;
    std::optional<BallLight> balls; ///< instead of `state`, of a network of particles
    int sweeps = 0;
    double links = 0.0;
    double seconds = 0.0; ///< [s] of the sweeps
    double setup = 0.0;   ///< [s] in which the network got medium and light, and particles their links
    double change = 0.0;
};

class NetworkAccuracy final : public AccuracyTechnique
{
public:
    explicit NetworkAccuracy(const CloudScene& scene) : scene_(scene)
    {
        isSmall_ = std::string_view(scene.name).ends_with("-small");
        isLarge_ = std::string_view(scene.name).ends_with("-large");
        size_ = isSmall_ ? kSmallPicture : isLarge_ ? kLargePicture : kPicture;
        for (const NetworkForm& form : kForms) {
            if (isLarge_ && form.form != Form::Closed && form.form != Form::Moving &&
                std::string_view(form.tier).empty())
                continue;
            forms_.push_back(&form);
            settings_.push_back({form.name,
                                 form.tier,
                                 {{"cells", form.cells},
                                  {"directions", form.directions},
                                  {"moments", form.moments},
                                  {"sweeps", form.sweeps}}});
            if (form.form == Form::Particles)
                settings_.back().parameters["segment"] = form.segment;
        }
    }

    std::string_view scene() const override { return scene_.name; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    std::vector<double> anisotropies() const
    {
        return isSmall_ ? std::vector<double>{0.0, 0.7} : std::vector<double>{0.0, 0.7, 0.85};
    }
    base::Result<const CloudTruth*> truthOf(double g, const std::function<bool()>& stop);
    base::Result<Solved> solve(const NetworkForm& form, double albedo, double g);
    base::Result<Solved> solveParticles(const NetworkForm& form, double albedo, double g);
    const LumpyCloud& frame(int f);

    const CloudScene& scene_;
    bool isSmall_, isLarge_;
    RaySize size_;
    std::vector<const NetworkForm*> forms_;
    std::vector<AccuracySetting> settings_;
    std::optional<LumpyCloud> cloud_;
    double sceneSeconds_ = 0.0; ///< [s] of fine grids and of the rays of a picture
    std::map<int, LumpyCloud> frames_;
    EyeRays rays_;
    std::map<double, CloudTruth> truths_; ///< by g
};

base::Result<const CloudTruth*> NetworkAccuracy::truthOf(double g, const std::function<bool()>& stop)
{
    const auto known = truths_.find(g);
    if (known != truths_.end())
        return &known->second;
    auto truth = tracedCloud(*cloud_, scene_.albedos, g, size_.size, size_.paths, stop);
    if (!truth.ok())
        return truth.status();
    return &truths_.emplace(g, std::move(*truth)).first->second;
}

/// The cloud so many frames before it is as in the picture.
const LumpyCloud& NetworkAccuracy::frame(int before)
{
    if (before == 0)
        return *cloud_;
    const auto known = frames_.find(before);
    if (known != frames_.end())
        return known->second;
    const double spread = std::pow(1.0 + kGrowth, -before);
    return frames_.emplace(before, LumpyCloud(scene_.depth, scene_.light, 64, spread)).first->second;
}

base::Result<Solved> NetworkAccuracy::solve(const NetworkForm& form, double albedo, double g)
{
    const auto tasks = base::makeSerialRunner();
    const bool isMoving = form.form == Form::Moving;
    const CloudNetwork asked{
        isSmall_ ? form.cells / 2 : form.cells, {form.directions, form.moments, g}, albedo};
    const render::SweepRules toRest{200, 2, 1e-3};
    render::ScatteringNetwork network;
    Solved solved;
    for (int before = isMoving ? kFrames : 0; before >= 0; --before) {
        const LumpyCloud& cloud = frame(before);
        const double startSetup = threadSeconds();
        if (base::Status status = give(cloud, asked, network); !status)
            return status;
        solved.setup = threadSeconds() - startSetup;
        const bool isToRest = form.sweeps == 0 || (isMoving && before == kFrames);
        const double start = threadSeconds();
        const render::SweepReport report =
            network.sweep(isToRest ? toRest : render::SweepRules{form.sweeps, 0, 0.0}, solved.state, *tasks);
        solved.seconds = threadSeconds() - start;
        solved.sweeps = report.sweeps;
        solved.change = report.change;
    }
    solved.phase = network.phase();
    return solved;
}

base::Result<Solved> NetworkAccuracy::solveParticles(const NetworkForm& form, double albedo, double g)
{
    const auto tasks = base::makeSerialRunner();
    render::ParticleNetwork network;
    Solved solved;
    const double start = threadSeconds();
    if (base::Status status =
            give(*cloud_, {form.directions, form.cells, form.segment, g}, albedo, network, *tasks);
        !status)
        return status;
    solved.setup = threadSeconds() - start;
    const render::SweepReport report = network.iterate({500, 2, 1e-3}, *tasks);
    std::vector<double> light;
    const glm::dvec3 eye = cloud_->camera().eye;
    for (size_t i = 0; i < cloud_->blobs().size(); ++i)
        light.push_back(network.scattered(i, glm::normalize(eye - cloud_->blobs()[i].center)));
    solved.balls.emplace(*cloud_, light);
    solved.seconds = threadSeconds() - start - solved.setup;
    solved.sweeps = report.sweeps;
    solved.change = report.change;
    solved.links = double(network.links());
    return solved;
}

base::Result<AccuracySample> NetworkAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (!cloud_) {
        const double start = threadSeconds();
        cloud_.emplace(scene_.depth, scene_.light, isSmall_ || isLarge_ ? 64 : 128);
        rays_ = raysThrough(*cloud_, size_);
        sceneSeconds_ = threadSeconds() - start;
    }
    const NetworkForm& form = *forms_[index];
    AccuracySample sample;
    std::vector<double> errors;
    std::string note;
    double network = 0.0, setup = 0.0, links = 0.0, reference = 0.0;
    double picturesSeconds = 0.0, pathsSeconds = 0.0; // of all pictures of the setting
    int sweeps = 0;
    for (const double g : anisotropies()) {
        const auto truth = truthOf(g, stop);
        if (!truth.ok())
            return truth.status();
        reference += (*truth)->seconds;
        for (int a = 0; a < 2; ++a) {
            if (stop())
                return interruptedStatus();
            const double albedo = scene_.albedos[a];
            std::vector<double> picture;
            double start = threadSeconds(), before = sceneSeconds_;
            if (form.form == Form::Single || form.form == Form::Closed) {
                picture = pictureOf(rays_, size_, [&](const EyeRay& ray) {
                    return withoutNetwork(rays_, ray, albedo, g, form.form == Form::Single);
                });
            } else {
                const auto solved =
                    form.form == Form::Particles ? solveParticles(form, albedo, g) : solve(form, albedo, g);
                if (!solved.ok())
                    return solved.status();
                network += solved->seconds;
                setup += solved->setup;
                links = std::max(links, solved->links);
                sweeps += solved->sweeps;
                sample.seconds += solved->seconds + (solved->balls ? solved->setup : 0.0);
                before += solved->setup + solved->seconds;
                start = threadSeconds();
                const render::GatherMoments moments(solved->phase, solved->state);
                picture = pictureOf(rays_, size_, [&](const EyeRay& ray) {
                    return solved->balls ? withParticles(rays_, ray, albedo, g, *solved->balls)
                                         : withNetwork(rays_, ray, albedo, solved->phase, moments);
                });
            }
            const double gathering = threadSeconds() - start;
            sample.seconds += gathering;
            errors.push_back(cloudError(picture, **truth, a));
            char name[64], text[32];
            std::snprintf(name, sizeof name, "times_faster_g%g_albedo%g", g, albedo);
            const double paths = pathSeconds(**truth, a, errors.back());
            sample.work[name] = paths / (before + gathering);
            picturesSeconds += before + gathering;
            pathsSeconds += paths;
            std::snprintf(name, sizeof name, "rmse_g%g_albedo%g", g, albedo);
            std::snprintf(text, sizeof text, "%s%.3f", note.empty() ? "RMSE " : " ", errors.back());
            sample.work[name] = errors.back();
            note += text;
        }
    }
    sample.items = double(errors.size());
    sample.note = note;
    render::MediumMoments medium; // what automatic scattering knows
    for (const render::MediumBlob& blob : cloud_->blobs())
        medium.add(blob.center, blob.radius, blob.crossSection, glm::dvec3(scene_.albedos[0]));
    sample.work["estimated_depth"] = medium.opticalDepth();
    sample.work["sweeps"] = sweeps;
    sample.work["seconds_network"] = network;
    sample.work["seconds_setup"] = setup;
    sample.work["seconds_pictures"] = picturesSeconds; // whole pictures, nothing is known before
    sample.work["seconds_paths"] = pathsSeconds;       // of the same errors
    sample.work["times_faster"] = pathsSeconds / picturesSeconds;
    if (links > 0.0)
        sample.work["links"] = links;
    sample.work["seconds_reference"] = reference;
    storeErrors(std::move(errors), sample);
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    for (const CloudScene& known : kScenes)
        if (scene == known.name)
            return std::make_unique<NetworkAccuracy>(known);
    return nullptr;
}

} // namespace

AccuracyTechniqueEntry networkAccuracy()
{
    std::vector<std::string> scenes;
    for (const CloudScene& scene : kScenes)
        scenes.emplace_back(scene.name);
    return {
        "network",
        "light scattered many times in a cloud of lumps, by illumination networks and a closed form, against "
        "paths",
        "picture",
        ShownError::Mean,
        scenes,
        kScenes.size() - 3, // without the last three
        false,
        make};
}

} // namespace fx::cli
