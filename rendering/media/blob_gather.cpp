#include "rendering/media/blob_gather.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/streak.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/frame/ball_window.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/frame/view_volume.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fx::render {

namespace {

namespace column = base::blob_column;
namespace constant = base::blob_constant;

constexpr uint32_t kMinImpostorBlobs = 16; ///< blobs; fewer are cheaper than their picture
constexpr size_t kMaxFarCasters = 16;      ///< of an effect that is drawn as a picture
/// Radius of the ball within a brick over that of the ball around it.
constexpr float kBrickCaster = base::kVolumeCasterRadius / base::kVolumeBallRadius;

float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

/// Reads one element of a group, blended with the same element of the older group.
class ElementReader
{
public:
    ElementReader(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t,
                  float stepSeconds)
        : newer_(newer), older_(older), t_(t), stepSeconds_(stepSeconds)
    {}

    /// Selects element i; elements must be selected in rising order. False: it is not yet born at this
    /// moment.
    bool select(size_t i)
    {
        i_ = i;
        hasOld_ = false;
        const uint64_t id = newer_.ids()[i];
        if (older_) {
            const auto ids = older_->ids();
            while (j_ < ids.size() && ids[j_] < id)
                ++j_;
            hasOld_ = j_ < ids.size() && ids[j_] == id;
        }
        return hasOld_ || !older_ || newer_.column(column::Age)[i] >= (1.0f - t_) * stepSeconds_;
    }

    float value(size_t c) const
    {
        const float now = newer_.column(c)[i_];
        return hasOld_ ? mix(older_->column(c)[j_], now, t_) : now;
    }
    glm::vec3 vector(size_t c) const { return {value(c), value(c + 1), value(c + 2)}; }
    glm::vec3 position() const
    {
        const glm::vec3 p = vector(column::PositionX);
        return hasOld_ || !older_ ? p : p - vector(column::VelocityX) * ((1.0f - t_) * stepSeconds_);
    }
    /// Of what is shown: between two snapshots, the way from one to the other.
    glm::vec3 velocity() const
    {
        if (!hasOld_ || !(stepSeconds_ > 0.0f))
            return vector(column::VelocityX);
        const auto way = [&](size_t c) { return newer_.column(c)[i_] - older_->column(c)[j_]; };
        return glm::vec3(way(column::PositionX), way(column::PositionY), way(column::PositionZ)) /
               stepSeconds_;
    }
    uint64_t id() const { return newer_.ids()[i_]; }
    std::array<glm::vec3, 2> carried(const BlobDetail& detail) const
    {
        return detail.carried(i_, j_, hasOld_, position());
    }

private:
    const base::SnapshotGroup& newer_;
    const base::SnapshotGroup* older_;
    float t_;
    float stepSeconds_;
    size_t i_ = 0;
    size_t j_ = 0;
    bool hasOld_ = false;
};

/// Squares are finite too: shaders take dot products, and compilers of drivers may negate comparisons.
bool finite(const GatheredBlob& b, const glm::vec3& velocity)
{
    const float values[] = {glm::dot(b.center, b.center),
                            b.radius * b.radius,
                            b.crossSection,
                            b.temperature,
                            b.albedo.x,
                            b.albedo.y,
                            b.albedo.z,
                            b.emission.x,
                            b.emission.y,
                            b.emission.z,
                            b.heat,
                            velocity.x,
                            velocity.y,
                            velocity.z};
    return base::allFinite(values, int(std::size(values)));
}

/// Which blobs of an effect that is drawn as a picture cast its shadow.
struct FarCasters
{
    size_t stride = 1;  ///< one of so many
    float share = 1.0f; ///< [1] blobs that each stands for
    size_t next = 0;    ///< number of the next, counted from the next group on
};

FarCasters farCasters(const base::FrameSnapshot& newer, size_t first)
{
    const base::GroupName name = newer.name(first);
    size_t count = 0;
    for (size_t g = first; g < newer.groupCount() && newer.name(g).instance == name.instance; ++g)
        count += newer.name(g).kind == name.kind ? newer.group(g).count() : 0;
    FarCasters far;
    far.stride = std::max<size_t>((count + kMaxFarCasters - 1) / kMaxFarCasters, 1);
    const size_t taken = (count + far.stride - 1) / far.stride;
    far.share = taken > 0 ? float(count) / float(taken) : 1.0f;
    return far;
}

/// Collects one group.
class GroupGather
{
public:
    GroupGather(const CameraGeometry& camera, int height, float share, LevelOfDetail* lod,
                std::pmr::vector<GatheredBlob>& visible, std::pmr::vector<MediumCaster>& medium,
                GatherCounts& counts)
        : camera_(camera), volume_(camera),
          pixelsPerSlope_(0.5f * float(height) * std::abs(camera.clipScale.y)), share_(share), lod_(lod),
          visible_(visible), medium_(medium), counts_(counts)
    {}

    /// Whether what is beside the view is left out.
    void cullToView(bool isCulled) { isCulled_ = isCulled; }
    /// A second camera, whose view is not culled.
    void alsoShowTo(const CameraGeometry& other)
    {
        otherVolume_.emplace(other);
        toOther_ = glm::vec3(camera_.eye - other.eye);
    }
    /// Whether the blobs of the next groups stand for the bricks of a volume, of which none may be left out.
    void standForBricks(bool areBricks) { areBricks_ = areBricks; }

    /// @param detail of the group  @param outDetailed receives its balls if it has detail
    /// @param place of the group, relative to the eye
    void run(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, const base::Placement& place,
             float t, float stepSeconds, const BlobDetail& detail,
             std::pmr::vector<DetailedCaster>* outDetailed)
    {
        level_ = lod_ && !areBricks_ ? lod_->levelOf(newer.info(), place) : LodLevel();
        const float shown = areBricks_ ? 1.0f : share_;
        const float casterRadius = areBricks_ ? kBrickCaster : 1.0f;
        const PlaceDrift drift = placeDrift(newer, older, stepSeconds);
        const std::span<const float> constants = newer.constants();
        ElementReader reader(newer, older, t, stepSeconds);
        for (size_t i = 0; i < newer.count(); ++i) {
            if (!reader.select(i))
                continue;
            const float rank = birthRank(reader.id());
            const float shadowWeight = weightOf(rank);
            if (shadowWeight == 0.0f) {
                ++counts_.thinned;
                continue;
            }
            GatheredBlob blob = read(reader, constants);
            blob.center = glm::vec3(place.position) + place.rotation * (reader.position() * place.scale);
            blob.radius *= place.scale;
            blob.crossSection *= place.scale * place.scale;
            const glm::vec3 velocity = place.rotation * (reader.vector(column::VelocityX) * place.scale);
            if (!finite(blob, velocity)) {
                ++counts_.nonFinite;
                continue;
            }
            if (!(blob.crossSection > 0.0f && blob.radius > 0.0f))
                continue;
            medium_.push_back({blob.center, blob.radius * casterRadius, blob.crossSection * shadowWeight});
            if (detail.isGiven()) {
                blob.carried = reader.carried(detail);
                outDetailed->push_back({medium_.back(), blob.carried, reader.id()});
            }
            const float shownWeight = rank < shown ? weightOf(rank / shown) : 0.0f; // uniform again
            if (shownWeight == 0.0f)
                continue;
            blob.crossSection *= shownWeight / shown;
            blob.velocity = place.rotation * (reader.velocity() * place.scale) + drift.at(reader.position());
            add(blob, velocity * constants[constant::Shutter], newer.info().instance, reader.id());
        }
    }

    /// Casters alone, of the next group of an effect that is drawn as a picture.
    void runFar(const base::SnapshotGroup& newer, const base::SnapshotGroup* older,
                const base::Placement& place, float t, float stepSeconds, FarCasters& ioFar)
    {
        const float back = older ? (1.0f - t) * stepSeconds : 0.0f;
        size_t i = ioFar.next;
        for (; i < newer.count(); i += ioFar.stride) {
            const auto value = [&](size_t c) { return newer.column(c)[i]; };
            const glm::vec3 position(value(column::PositionX), value(column::PositionY),
                                     value(column::PositionZ));
            const glm::vec3 velocity(value(column::VelocityX), value(column::VelocityY),
                                     value(column::VelocityZ));
            const glm::vec3 center =
                glm::vec3(place.position) + place.rotation * ((position - back * velocity) * place.scale);
            const float radius = value(column::Radius) * place.scale * std::cbrt(ioFar.share);
            const float section = value(column::CrossSection) * place.scale * place.scale * ioFar.share;
            const float values[] = {glm::dot(center, center), radius * radius, section};
            if (base::allFinite(values, int(std::size(values))) && radius > 0.0f && section > 0.0f)
                medium_.push_back({center, radius, section});
        }
        ioFar.next = i - newer.count();
    }

private:
    static GatheredBlob read(const ElementReader& reader, std::span<const float> constants)
    {
        GatheredBlob blob;
        blob.radius = reader.value(column::Radius);
        blob.crossSection = reader.value(column::CrossSection);
        blob.temperature = reader.value(column::Temperature);
        blob.albedo = reader.vector(column::AlbedoR);
        blob.emission = reader.vector(column::EmissionR);
        blob.tint = base::tintOf(constants);
        blob.fireShare = glm::clamp(reader.value(column::FireShare), 0.0f, 1.0f);
        blob.heat = reader.value(column::Heat);
        blob.seed = detailSeed(reader.id());
        blob.detailAmount = constants[constant::DetailAmount];
        blob.detailScale = constants[constant::DetailScale];
        blob.anisotropy = constants[constant::Anisotropy];
        blob.layer = uint32_t(constants[constant::Layer]);
        return blob;
    }

    /// What a blob's cross section is multiplied by for the level of detail.
    float weightOf(float rank) const
    {
        return level_.ramp.isAll() ? 1.0f : level_.ramp.weight(rank) / level_.ramp.mean();
    }

    void add(GatheredBlob blob, const glm::vec3& streak, uint64_t instance, uint64_t id)
    {
        const float depth = camera_.orthographic ? 1.0f : glm::length(blob.center);
        const float pixel = depth / pixelsPerSlope_; // [m]
        const float grown = std::min({blob.radius / std::sqrt(level_.ramp.mean()), level_.grownPixels * pixel,
                                      blob.radius + level_.swollenPixels * pixel});
        blob.radius = std::max(blob.radius, grown);
        if (const float least = kMinPixels * pixel; blob.radius < least) {
            blob.crossSection = formula::fxWidenedSection(blob.crossSection, blob.radius, least);
            blob.radius = least;
        }
        const base::Streak<float> line = base::streakOf(glm::length(streak), blob.radius);
        const glm::vec3 head = blob.center;
        const float section = blob.crossSection;
        blob.radius = line.radius;
        for (int k = 0; k < line.count; ++k) {
            blob.center = head - streak * (float(k) / float(line.count));
            blob.crossSection = section * line.shareOf(k);
            blob.rank = listRank(instance, id, k);
            if (!isCulled_ || volume_.touches(blob.center, blob.radius) ||
                (otherVolume_ && otherVolume_->touches(blob.center + toOther_, blob.radius)))
                visible_.push_back(blob);
            else
                ++counts_.culled;
        }
    }

    const CameraGeometry& camera_;
    ViewVolume volume_;
    std::optional<ViewVolume> otherVolume_;
    glm::vec3 toOther_{0.0f}; ///< [m] from places relative to the eye to those relative to the other eye
    float pixelsPerSlope_;
    float share_;
    LevelOfDetail* lod_;
    LodLevel level_;
    bool isCulled_ = true;
    bool areBricks_ = false;
    std::pmr::vector<GatheredBlob>& visible_;
    std::pmr::vector<MediumCaster>& medium_;
    GatherCounts& counts_;
};

/// What is to be done with the instance whose first group of blobs is number `first`.
ImpostorPlan planImpostor(const base::SnapshotPair& snapshots, size_t first, float t,
                          const CameraGeometry& camera, int height, ImpostorField& impostors)
{
    const base::FrameSnapshot& newer = *snapshots.newer;
    const base::GroupInfo& info = newer.group(first).info();
    base::Bounds around;
    uint32_t count = 0;
    for (size_t g = first; g < newer.groupCount(); ++g) {
        const base::GroupName name = newer.name(g);
        if (name.instance != info.instance)
            break;
        if (name.kind != info.kind || newer.group(g).count() == 0)
            continue;
        const base::SnapshotGroup& group = newer.group(g);
        if (group.info().bounds.empty())
            return {};
        const size_t same = findSameGroup(snapshots.older, newer, g);
        const auto* older = same == kNoGroup ? nullptr : &snapshots.older->group(same);
        const base::Placement place = placementAt(snapshots, group, older, t, camera.eye);
        const base::Bounds& bounds = group.info().bounds;
        around.add(glm::vec3(place.position) +
                       place.rotation * (0.5f * (bounds.min + bounds.max) * place.scale),
                   0.5f * glm::length(bounds.max - bounds.min) * place.scale);
        count += group.count();
    }
    if (count < kMinImpostorBlobs || camera.orthographic)
        return {};
    ImpostorSubject subject{info.instance, 0.5f * (around.min + around.max), 0.0f, 0.0f};
    subject.radius = 0.5f * std::max({around.max.x - around.min.x, around.max.y - around.min.y,
                                      around.max.z - around.min.z});
    if (!ViewVolume(camera).touches(subject.center, subject.radius))
        return {};
    subject.pixels = subject.radius * 0.5f * float(height) * std::abs(camera.clipScale.y) /
                     std::max(glm::length(subject.center), 1e-6f);
    return impostors.plan(subject);
}

/// Neighboring groups without detail are one run.
void addRun(const BlobRun& run, std::pmr::vector<BlobRun>& ioRuns)
{
    const bool goesOn = run.detail < 0 && run.volume < 0 && !ioRuns.empty() &&
                        ioRuns.back().instance == run.instance && ioRuns.back().detail < 0 &&
                        ioRuns.back().volume < 0;
    if (!goesOn) {
        ioRuns.push_back(run);
        return;
    }
    ioRuns.back().visibleEnd = run.visibleEnd;
    ioRuns.back().mediumEnd = run.mediumEnd;
}

bool hasLateBalls(uint64_t instance, std::span<const LateBalls> late)
{
    return std::ranges::any_of(late, [=](const LateBalls& balls) { return balls.name.instance == instance; });
}

const LateBalls* lateBallsOf(const base::GroupName& name, std::span<const LateBalls> late)
{
    const auto same = std::ranges::find(late, name, &LateBalls::name);
    return same == late.end() ? nullptr : &*same;
}

void addLate(const LateBalls& late, std::pmr::vector<GatheredBlob>& ioVisible,
             std::pmr::vector<MediumCaster>& ioMedium, std::pmr::vector<InstanceBlobs>& ioInstances,
             FieldGather* ioFields)
{
    const size_t visibleBegin = ioVisible.size(), mediumBegin = ioMedium.size();
    ioVisible.insert(ioVisible.end(), late.visible.begin(), late.visible.end());
    ioMedium.insert(ioMedium.end(), late.casters.begin(), late.casters.end());
    ioInstances.back().visibleEnd = ioVisible.size();
    if (!ioFields)
        return;
    if (late.detail)
        ioFields->details.push_back(*late.detail);
    addRun({ioInstances.size() - 1, late.detail ? int(ioFields->details.size()) - 1 : -1, visibleBegin,
            ioVisible.size(), mediumBegin, ioMedium.size()},
           ioFields->runs);
}

} // namespace

GatherCounts gatherBlobs(const base::SnapshotPair& snapshots, double interpolation,
                         const CameraGeometry& camera, int height, std::pmr::vector<GatheredBlob>& outVisible,
                         std::pmr::vector<MediumCaster>& outMedium,
                         std::pmr::vector<InstanceBlobs>& outInstances, float share, LevelOfDetail* lod,
                         ImpostorField* impostors, bool castsShadows, FieldGather* outFields,
                         std::span<const LateBalls> late, const CameraGeometry* otherEye)
{
    GatherCounts counts;
    if (!snapshots.newer)
        return counts;
    const base::FrameSnapshot& newer = *snapshots.newer;
    const base::KindId kind = newer.schema().find(base::kBlobKind.name);
    const float t = float(glm::clamp(interpolation, 0.0, 1.0));
    const float stepSeconds =
        snapshots.older ? float(base::toSeconds(newer.tick() - snapshots.older->tick())) : 0.0f;
    GroupGather gather(camera, height, share, lod, outVisible, outMedium, counts);
    if (otherEye)
        gather.alsoShowTo(*otherEye);
    FarCasters far;
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        if (newer.name(g).kind != kind)
            continue;
        const uint64_t instance = newer.name(g).instance;
        if (outInstances.empty() || outInstances.back().instance != instance) {
            const bool isPlanned = impostors && !hasLateBalls(instance, late);
            const ImpostorPlan plan =
                isPlanned ? planImpostor(snapshots, g, t, camera, height, *impostors) : ImpostorPlan();
            outInstances.push_back({instance, outVisible.size(), outVisible.size(), plan});
            gather.cullToView(!plan.isTaken);
            if (plan.blobShare <= 0.0f && !plan.isTaken)
                far = farCasters(newer, g);
        }
        if (const LateBalls* const given = lateBallsOf(newer.name(g), late)) {
            addLate(*given, outVisible, outMedium, outInstances, outFields);
            continue;
        }
        const base::SnapshotGroup& group = newer.group(g);
        const ImpostorPlan& plan = outInstances.back().plan;
        const size_t same = findSameGroup(snapshots.older, newer, g);
        const base::SnapshotGroup* older = same == kNoGroup ? nullptr : &snapshots.older->group(same);
        const base::Placement place = placementAt(snapshots, group, older, t, camera.eye);
        const BlobDetail detail = outFields ? BlobDetail(snapshots, g, t) : BlobDetail();
        const base::SnapshotGroup* const volume = outFields ? volumeGroup(newer, g) : nullptr;
        gather.standForBricks(volume != nullptr);
        const size_t visibleBegin = outVisible.size(), mediumBegin = outMedium.size();
        if (detail.isGiven())
            outFields->casters.clear();
        if (plan.blobShare > 0.0f || plan.isTaken)
            gather.run(group, older, place, t, stepSeconds, detail,
                       outFields ? &outFields->casters : nullptr);
        else if (castsShadows)
            gather.runFar(group, older, place, t, stepSeconds, far);
        outInstances.back().visibleEnd = outVisible.size();
        if (!outFields)
            continue;
        if (detail.isGiven()) {
            GroupDetail made = detail.groupDetail(place);
            made.factor = outFields->conservation.of(made, outFields->casters);
            outFields->details.push_back(made);
        }
        if (volume) {
            outFields->volumes.push_back(groupVolume(group, *volume, place, older ? double(t) : 1.0));
            outFields->volumes.back().density *= double(plan.blobShare); // the rest is in a picture
        }
        addRun({outInstances.size() - 1, detail.isGiven() ? int(outFields->details.size()) - 1 : -1,
                visibleBegin, outVisible.size(), mediumBegin, outMedium.size(),
                volume ? int(outFields->volumes.size()) - 1 : -1},
               outFields->runs);
    }
    return counts;
}

} // namespace fx::render
