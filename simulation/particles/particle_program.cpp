#include "simulation/particles/particle_program.h"

#include "simulation/particles/builtin_ops.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace fx::sim {

namespace {

constexpr float kLongestLife = 1e9f;
constexpr float kBrief = 3.0f; // [s] twice of it fits into 2^32 ticks

bool varies(const base::Range& range)
{
    return range.max > range.min;
}

float longestLife(const EmitterSettings& def)
{
    const float longest = varies(def.lifetime) ? def.lifetime.max : def.lifetime.min;
    return longest > 0.0f ? std::min(longest, kLongestLife) : 0.0f;
}

RampCurves lifeCurves(const EmitterSettings& def)
{
    const auto& color = def.appearance.colorOverLife;
    return RampCurves(std::array{samplesOf(color, 0), samplesOf(color, 1), samplesOf(color, 2),
                                 samplesOf(def.opacityOverLife, 0), samplesOf(def.sizeOverLife, 0)});
}

std::unique_ptr<RampCurves> speedCurves(const EmitterAppearance& appearance)
{
    if (!(appearance.fastest > 0.0f))
        return nullptr;
    const auto& color = appearance.colorOverSpeed;
    return std::make_unique<RampCurves>(
        std::array{samplesOf(color, 0), samplesOf(color, 1), samplesOf(color, 2),
                   samplesOf(appearance.opacityOverSpeed, 0), samplesOf(appearance.sizeOverSpeed, 0)});
}

base::ColumnSet publishedColumns(const EmitterSettings& def)
{
    namespace column = base::particle_column;
    const EmitterAppearance& appearance = def.appearance;
    base::ColumnSet set = column::kAlways;
    const bool turns = appearance.angle.min != 0 || varies(appearance.angle) || appearance.spin.min != 0 ||
                       varies(appearance.spin);
    if (appearance.kind == AppearanceKind::Mesh)
        set |= column::kOrientation;
    else if (turns)
        set |= column::kAngle;
    // The head of a trail has to be where the trail ends, also between birth and the first snapshot.
    if (appearance.alignment == base::SpriteAlignment::Velocity || appearance.stretch > 0.0f ||
        def.trail.lifetime > 0.0f)
        set |= column::kVelocity;
    if (appearance.frames != FrameClock::None || appearance.firstFrame.min != 0 ||
        varies(appearance.firstFrame))
        set |= column::kFrame;
    return set;
}

/// Programs are made by several threads.
uint64_t nextNumber()
{
    static std::atomic<uint64_t> last{0};
    return ++last;
}

/// Whether the pass that only has to do what most emitters need does all that this one needs.
bool isPlain(const ParticleProgram& program)
{
    const EmitterAppearance& appearance = program.def.appearance;
    bool plain = program.published == base::particle_column::kAlways && !program.bySpeed &&
                 !program.byLife.byTable && appearance.brightness.min == 1.0f &&
                 !varies(appearance.brightness) && !program.def.tinted;
    for (uint32_t c = appearance_channel::Red; c <= appearance_channel::Blue;
         ++c) // more than rounding within the bounds
        plain = plain && program.byLife.lowest(c) > 1e-3f * program.byLife.highest(c) &&
                program.byLife.highest(c) < 6e4f;
    return plain;
}

/// [s] by so much times its speed a sprite is longer to each side.
float stretchOf(const EmitterAppearance& appearance)
{
    const bool isLonger =
        appearance.alignment == base::SpriteAlignment::Velocity && appearance.kind == AppearanceKind::Sprite;
    return isLonger ? 0.5f * kRoundedUp * appearance.stretch : 0.0f;
}

/// Decides attribute by attribute whether it is the same for all.
void chooseColumns(ParticleProgram& program)
{
    const EmitterSettings& def = program.def;
    const auto choose = [&program](size_t column, const base::Range& range) {
        program.stores[column] = varies(range);
        program.constant[column] = range.min;
    };
    const bool medium = def.appearance.kind == AppearanceKind::Medium;
    const bool fixed =
        def.shape == EmitterShape::Point && !def.births && !def.fed && !def.inWorld && program.ballistic;
    for (size_t a = 0; a < 3; ++a) {
        program.stores[stored::X + a] = !fixed;
        program.constant[stored::X + a] = def.position[int(a)];
        program.stores[stored::VelocityX + a] = true;
        program.stores[stored::AxisX + a] = def.appearance.kind == AppearanceKind::Mesh;
        program.stores[stored::TintRed + a] = def.tinted;
        program.constant[stored::TintRed + a] = 1.0f;
    }
    choose(stored::PerLife, def.lifetime);
    program.constant[stored::PerLife] = perLifeOf(def.lifetime.min);
    program.stores[stored::PerLife] = program.stores[stored::PerLife] || program.mortal;
    choose(stored::Radius, def.radius);
    choose(stored::Amount, medium ? base::Range{0, 1} : def.appearance.opacity);
    choose(stored::Excess, medium || def.forces.buoyancy != 0.0f ? base::Range{0, 1} : base::Range{});
    choose(stored::Angle, def.appearance.angle);
    choose(stored::Spin, def.appearance.spin);
    choose(stored::Frame, def.appearance.firstFrame);
    choose(stored::Brightness, def.appearance.brightness);
}

} // namespace

float perLifeOf(float seconds)
{
    return seconds > 0.0f ? 1.0f / std::clamp(seconds, 1.0f / kNoLife, kLongestLife) : kNoLife;
}

double stepWork(const ParticleProgram& program)
{
    using namespace emitter_work;
    const EmitterSettings& def = program.def;
    double work = kKept + (def.events.empty() ? 0.0 : kScan);
    if (!program.ballistic)
        work += kMoved + kForce * double(program.ops.size());
    return work + (def.forces.curlStrength > 0.0f ? kOctave * double(def.forces.curlOctaves) : 0.0);
}

double shownWork(AppearanceKind kind)
{
    if (kind == AppearanceKind::None)
        return 0.0;
    return kind == AppearanceKind::Medium ? emitter_work::kListed + emitter_work::kMedium
                                          : emitter_work::kDrawn;
}

size_t bytesMoved(const ParticleProgram& program)
{
    size_t bytes = program.brief ? sizeof(uint32_t) : sizeof(base::Ticks);
    for (const bool isStored : program.stores)
        bytes += isStored ? sizeof(float) : 0;
    for (size_t c = 0; c < base::particle_column::Count; ++c)
        if ((program.published >> c & 1) != 0)
            bytes += base::columnElementSize(base::kParticleColumns[c].type);
    if (!program.ballistic) // place and velocity back and forth, birth tick and index
        bytes += 6 * 2 * sizeof(float) + sizeof(base::Ticks) + sizeof(uint64_t);
    return bytes;
}

float cornerOf(const EmitterAppearance& appearance)
{
    constexpr float kRounding = 1.00002f; // of the arithmetic that draws
    return kRounding * (appearance.kind == AppearanceKind::Mesh
                            ? appearance.meshReach
                            : std::sqrt(1.0f + appearance.aspect * appearance.aspect));
}

ParticleProgram::ParticleProgram(const EmitterSettings& definition)
    : def(definition), number(nextNumber()), ballistic(definition.isBallistic()),
      brief(sim::longestLife(definition) <= kBrief), mortal(!definition.modules.empty()),
      longestLife(base::toTicks(double(sim::longestLife(definition)))),
      published(publishedColumns(definition)), byLife(lifeCurves(definition)),
      bySpeed(speedCurves(definition.appearance)), corner(cornerOf(definition.appearance)),
      plain(isPlain(*this))
{
    if (!ballistic) {
        addBuiltinOps(definition, ops);
        ops.insert(ops.end(), definition.modules.begin(), definition.modules.end());
        std::stable_sort(ops.begin(), ops.end(),
                         [](const auto& a, const auto& b) { return a->phase() < b->phase(); });
    }
    for (const std::shared_ptr<const TileOp>& op : ops)
        keepsFlags = keepsFlags || op->keepsFlags();
    chooseColumns(*this);
    const bool turns = (published & base::particle_column::kAngle) != 0;
    (turns ? across : along) = stretchOf(def.appearance) / (turns ? corner : 1.0f);
}

} // namespace fx::sim
