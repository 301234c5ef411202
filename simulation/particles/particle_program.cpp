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

RampCurves lookCurves(const EmitterSettings& def)
{
    const auto& color = def.look.colorOverLife;
    return RampCurves(std::array{samplesOf(color, 0), samplesOf(color, 1), samplesOf(color, 2),
                                 samplesOf(def.opacityOverLife, 0), samplesOf(def.sizeOverLife, 0)});
}

std::unique_ptr<RampCurves> speedCurves(const EmitterLook& look)
{
    if (!(look.fastest > 0.0f))
        return nullptr;
    const auto& color = look.colorOverSpeed;
    return std::make_unique<RampCurves>(std::array{samplesOf(color, 0), samplesOf(color, 1),
                                                   samplesOf(color, 2), samplesOf(look.opacityOverSpeed, 0),
                                                   samplesOf(look.sizeOverSpeed, 0)});
}

base::ColumnSet publishedColumns(const EmitterLook& look)
{
    namespace column = base::particle_column;
    base::ColumnSet set = column::kAlways;
    const bool turns = look.angle.min != 0 || varies(look.angle) || look.spin.min != 0 || varies(look.spin);
    if (look.kind == Appearance::Mesh)
        set |= column::kOrientation;
    else if (turns)
        set |= column::kAngle;
    if (look.alignment == base::SpriteAlignment::Velocity || look.stretch > 0.0f)
        set |= column::kVelocity;
    if (look.frames != FrameClock::None || look.firstFrame.min != 0 || varies(look.firstFrame))
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
    const EmitterLook& look = program.def.look;
    bool plain = program.published == base::particle_column::kAlways && !program.bySpeed &&
                 !program.looks.byTable && look.brightness.min == 1.0f && !varies(look.brightness) &&
                 !program.def.tinted;
    for (uint32_t c = look_channel::Red; c <= look_channel::Blue; ++c) // more than rounding within the bounds
        plain = plain && program.looks.lowest(c) > 1e-3f * program.looks.highest(c) &&
                program.looks.highest(c) < 6e4f;
    return plain;
}

/// [s] by so much times its speed a sprite is longer to each side.
float stretchOf(const EmitterLook& look)
{
    const bool isLonger =
        look.alignment == base::SpriteAlignment::Velocity && look.kind == Appearance::Sprite;
    return isLonger ? 0.5f * kRoundedUp * look.stretch : 0.0f;
}

/// Decides attribute by attribute whether it is the same for all.
void chooseColumns(ParticleProgram& program)
{
    const EmitterSettings& def = program.def;
    const auto choose = [&program](size_t column, const base::Range& range) {
        program.stores[column] = varies(range);
        program.constant[column] = range.min;
    };
    const bool medium = def.look.kind == Appearance::Medium;
    const bool fixed =
        def.shape == EmitterShape::Point && !def.births && !def.fed && !def.inWorld && program.ballistic;
    for (size_t a = 0; a < 3; ++a) {
        program.stores[stored::X + a] = !fixed;
        program.constant[stored::X + a] = def.position[int(a)];
        program.stores[stored::VelocityX + a] = true;
        program.stores[stored::AxisX + a] = def.look.kind == Appearance::Mesh;
        program.stores[stored::TintRed + a] = def.tinted;
        program.constant[stored::TintRed + a] = 1.0f;
    }
    choose(stored::PerLife, def.lifetime);
    program.constant[stored::PerLife] = perLifeOf(def.lifetime.min);
    program.stores[stored::PerLife] = program.stores[stored::PerLife] || program.mortal;
    choose(stored::Radius, def.radius);
    choose(stored::Amount, medium ? base::Range{0, 1} : def.look.opacity);
    choose(stored::Excess, medium || def.forces.buoyancy != 0.0f ? base::Range{0, 1} : base::Range{});
    choose(stored::Angle, def.look.angle);
    choose(stored::Spin, def.look.spin);
    choose(stored::Frame, def.look.firstFrame);
    choose(stored::Brightness, def.look.brightness);
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

double shownWork(Appearance kind)
{
    if (kind == Appearance::None)
        return 0.0;
    return kind == Appearance::Medium ? emitter_work::kListed + emitter_work::kMedium : emitter_work::kDrawn;
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

float cornerOf(const EmitterLook& look)
{
    constexpr float kRounding = 1.00002f; // of the arithmetic that draws
    return kRounding *
           (look.kind == Appearance::Mesh ? look.meshReach : std::sqrt(1.0f + look.aspect * look.aspect));
}

ParticleProgram::ParticleProgram(const EmitterSettings& definition)
    : def(definition), number(nextNumber()), ballistic(definition.isBallistic()),
      brief(sim::longestLife(definition) <= kBrief), mortal(!definition.modules.empty()),
      longestLife(base::toTicks(double(sim::longestLife(definition)))),
      published(publishedColumns(definition.look)), looks(lookCurves(definition)),
      bySpeed(speedCurves(definition.look)), corner(cornerOf(definition.look)), plain(isPlain(*this))
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
    (turns ? across : along) = stretchOf(def.look) / (turns ? corner : 1.0f);
}

} // namespace fx::sim
