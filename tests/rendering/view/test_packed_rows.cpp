// What shaders read of packed rows is what was packed, to the errors that packed_rows.h states, and what is
// mixed before it is packed is what they make of two packed states.
#include "foundation/math/half.h"
#include "particle_fixture.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/particle_rows/packed_rows.h"
#include "rendering/passes/particle_batch.h"
#include "shaders/shader_library.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace fx;
using namespace fx::test;
namespace column = base::particle_column;

namespace {

constexpr uint32_t kRows = 3000;
constexpr double kSeconds = 1.0 / 60.0;

/// What the shader writes for a row.
struct Read
{
    glm::vec4 center;   ///< w: radius
    glm::vec4 velocity; ///< w: 1 alive
    glm::vec4 color;
    glm::vec4 turned; ///< x angle, y frame
    glm::vec4 orientation;
};

constexpr const char* kMain = R"(
layout(local_size_x = 64) in;
struct Read { vec4 center; vec4 velocity; vec4 color; vec4 turned; vec4 orientation; };
layout(std430, binding = 4) writeonly buffer Out { Read reads[]; };
void main()
{
    int row = int(gl_GlobalInvocationID.x);
    if (row >= rows.x)
        return;
    Particle p = fetchParticle(row);
    reads[row] = Read(vec4(p.center, p.radius), vec4(p.velocity, p.alive ? 1.0 : 0.0), p.color,
                      vec4(p.angle, p.frame, 0.0, 0.0), p.orientation);
}
)";

/// Rows of one state on the GPU.
struct Packed
{
    render::RowPlaces places{};
    uint32_t rows = 0;
    std::vector<std::byte> bytes;
};

class PackedRows : public ParticleTest
{
protected:
    static std::string textOf(const char* name, bool withPrologue)
    {
        std::string text = *shaders::assemble(name, "");
        for (int line = 0; line < 3 && !withPrologue; ++line)
            text.erase(0, text.find('\n') + 1);
        return text;
    }

    uint32_t makeProgram()
    {
        auto& gl = device_->gl;
        const std::string text = textOf("shared/particle_block.glsl", true) +
                                 textOf("shared/view_block.glsl", false) +
                                 textOf("shared/particle_fetch.glsl", false) + kMain;
        const char* source = text.c_str();
        const uint32_t shader = gl.CreateShader(GL_COMPUTE_SHADER);
        gl.ShaderSource(shader, 1, &source, nullptr);
        gl.CompileShader(shader);
        const uint32_t program = gl.CreateProgram();
        gl.AttachShader(program, shader);
        gl.LinkProgram(program);
        GLint linked = 0;
        gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
        EXPECT_EQ(linked, 1);
        gl.DeleteShader(shader);
        return program;
    }

    uint32_t bufferOf(std::span<const std::byte> bytes)
    {
        buffers_.push_back(std::move(*render::GlBuffer::create(*device_, bytes.size(), "test")));
        device_->gl.NamedBufferSubData(buffers_.back().name(), 0, GLsizeiptr(bytes.size()), bytes.data());
        return buffers_.back().name();
    }

    /// What fetchParticle() makes of the rows.
    std::vector<Read> read(const Packed& newer, const Packed* older = nullptr, float share = 1.0f)
    {
        auto& gl = device_->gl;
        render::ParticleBlock block{};
        block.placePosition = {0, 0, 0, 1};
        block.placeRotation = {0, 0, 0, 1};
        block.moment = {share, float(kSeconds), older ? 1.0f : 0.0f, 0.5f};
        block.newerAt = newer.places;
        block.olderAt = older ? older->places : newer.places;
        block.rows = {int32_t(newer.rows), older ? int32_t(older->rows) : 0, 0, 0};
        std::vector<Read> out(newer.rows);
        buffers_.clear();
        const uint32_t program = makeProgram();
        gl.UseProgram(program);
        gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, bufferOf(std::as_bytes(std::span(&block, 1))));
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, bufferOf(newer.bytes));
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, bufferOf(older ? older->bytes : newer.bytes));
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, bufferOf(newer.bytes));
        const uint32_t result = bufferOf(std::as_bytes(std::span(out)));
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, result);
        gl.DispatchCompute((newer.rows + 63) / 64, 1, 1);
        gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
        gl.GetNamedBufferSubData(result, 0, GLsizeiptr(out.size() * sizeof(Read)), out.data());
        gl.UseProgram(0);
        gl.DeleteProgram(program);
        return out;
    }

    static Packed pack(const base::SnapshotGroup& group)
    {
        Packed packed;
        packed.rows = group.count();
        packed.bytes.resize(render::layOutPacked(group, group.count(), packed.places) * 4);
        const uint32_t cut = group.count() / 3; // parts are packed by themselves
        render::packRows(group, 0, cut, packed.places, packed.bytes.data());
        render::packRows(group, cut, group.count() - cut, packed.places, packed.bytes.data());
        return packed;
    }

    std::vector<render::GlBuffer> buffers_;
};

std::vector<TestParticle> manyParticles(uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<TestParticle> all(kRows);
    for (TestParticle& p : all) {
        const auto any = [&] { return uniform(random); };
        p.center = {100.0f * any(), 3.0f * any(), 1e4f * any()};
        p.radius = std::exp2(20.0f * any());
        p.color = std::exp2(12.0f * any()) * glm::vec4(glm::abs(glm::vec3(any(), any(), any())), 0.0f);
        p.color.a = std::abs(any());
        p.age = 0.5f + 0.4f * any();
        p.velocity = std::exp2(10.0f * any()) * glm::vec3(any(), any(), any());
        p.angle = 50.0f * any();
        p.frame = 20.0f + 20.0f * any();
        p.orientation = glm::normalize(glm::quat(any(), any(), any(), any()));
    }
    return all;
}

float largest(const glm::vec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::vec4 asPublished(const glm::vec4& color)
{
    return glm::unpackHalf4x16(packColor(color));
}

double turnBetween(double a, double b)
{
    return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

} // namespace

TEST_F(PackedRows, areReadByShadersToTheErrorsThatAreStated)
{
    const auto particles = manyParticles(1);
    for (const base::ColumnSet columns :
         {base::kAllColumns, base::ColumnSet(column::kAlways | column::kVelocity)})
    {
        auto snapshot = emptySnapshot();
        const bool hasAngle = columns == base::kAllColumns;
        const auto reads = read(pack(addParticles(snapshot, particles, columns)));
        for (uint32_t i = 0; i < kRows; ++i) {
            const TestParticle& p = particles[i];
            const Read& r = reads[i];
            ASSERT_EQ(glm::vec3(r.center), p.center) << i;
            ASSERT_LE(std::abs(r.center.w - p.radius), p.radius / 4096.0f) << i;
            ASSERT_EQ(r.velocity.w, 1.0f) << i;
            const float most = largest(p.velocity) / (hasAngle ? 256.0f : 4096.0f);
            ASSERT_LE(largest(glm::vec3(r.velocity) - p.velocity), most) << i;
            const glm::vec4 color = asPublished(p.color);
            ASSERT_LE(largest(glm::vec3(r.color) - glm::vec3(color)), largest(glm::vec3(color)) / 4096.0f)
                << i;
            ASSERT_EQ(r.color.a, color.a) << i;
            ASSERT_EQ(r.turned.y, hasAngle ? p.frame : 0.0f) << i;
            ASSERT_LE(turnBetween(r.turned.x, hasAngle ? p.angle : 0.0f), std::numbers::pi / 4096.0 + 1e-5);
            const glm::quat q = hasAngle ? p.orientation : glm::quat(1, 0, 0, 0);
            for (int k = 0; k < 4; ++k)
                ASSERT_NEAR(r.orientation[k], (glm::vec4(q.x, q.y, q.z, q.w))[k], 4.0 / 65536.0);
        }
    }
}

TEST_F(PackedRows, keepWhatIsUsualExactlyAndBoundWhatIsNot)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    std::vector<TestParticle> rows(7);
    rows[0].color = {1.0f, 0.5f, 0.25f, 0.125f};
    rows[0].velocity = {0.0f, -9.0f, 0.5f};
    rows[1].radius = 0.0f;
    rows[2].radius = 1e-30f;
    rows[3].radius = nan;
    rows[4].radius = infinity;
    rows[4].velocity = {infinity, -infinity, nan};
    rows[4].angle = nan;
    rows[5].color = {65504.0f, 0.0f, 1e-7f, 1.0f};
    rows[6].color = {infinity, nan, -1.0f, -1.0f};
    auto snapshot = emptySnapshot();
    const auto reads =
        read(pack(addParticles(snapshot, rows, column::kAlways | column::kVelocity | column::kAngle)));
    EXPECT_EQ(reads[0].color, rows[0].color);
    EXPECT_EQ(reads[0].center.w, 1.0f);
    EXPECT_EQ(glm::vec3(reads[0].velocity), rows[0].velocity);
    EXPECT_EQ(reads[0].turned.x, 0.0f);
    EXPECT_EQ(reads[1].velocity.w, 0.0f) << "an empty row";
    EXPECT_EQ(reads[2].velocity.w, 1.0f) << "what is tiny is not empty";
    EXPECT_EQ(reads[3].velocity.w, 0.0f);
    EXPECT_GT(reads[4].center.w, 1e7f);
    for (const Read& r : reads)
        for (int k = 0; k < 4; ++k)
            EXPECT_TRUE(std::isfinite(r.center[k]) && std::isfinite(r.velocity[k]) &&
                        std::isfinite(r.color[k]) && std::isfinite(r.turned[k]));
    EXPECT_NEAR(reads[5].color.r, 65504.0f, 16.0f);
    EXPECT_EQ(reads[6].color.b, 0.0f);
    EXPECT_EQ(reads[6].color.a, 0.0f);
}

TEST_F(PackedRows, takeAtMostTwentyEightBytesOfASprite)
{
    const std::vector<TestParticle> rows(40);
    const auto bytesOf = [&](base::ColumnSet columns) {
        auto snapshot = emptySnapshot();
        return render::packedRowBytes(pack(addParticles(snapshot, rows, columns)).places);
    };
    EXPECT_EQ(bytesOf(column::kAlways), 24u);
    EXPECT_EQ(bytesOf(column::kAlways | column::kAngle), 24u);
    EXPECT_EQ(bytesOf(column::kAlways | column::kVelocity), 28u);
    EXPECT_EQ(bytesOf(column::kAlways | column::kVelocity | column::kAngle), 28u);
    EXPECT_EQ(bytesOf(column::kAlways | column::kFrame | column::kAngle), 28u);
    EXPECT_EQ(bytesOf(base::kAllColumns), 40u) << "a mesh that turns, flies and changes its picture";
}

TEST_F(PackedRows, thatAreMixedBeforeAreWhatShadersMixOfTwoStates)
{
    auto before = manyParticles(2);
    auto after = before;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (uint32_t i = 0; i < kRows; ++i) {
        after[i].center += before[i].velocity * float(kSeconds);
        after[i].age += float(kSeconds);
        after[i].angle += 0.3f;
        after[i].frame += i % 7 == 0 ? -3.0f : 0.25f; // some begin anew
        after[i].orientation = glm::quat(-after[i].orientation.w, -after[i].orientation.x,
                                         -after[i].orientation.y, -after[i].orientation.z);
        if (i % 5 == 0) // born within the step, where another lived
            after[i].age = float(kSeconds) * (0.002f + 0.9f * uniform(random));
        if (i % 11 == 0)
            before[i].radius = 0.0f;
        if (i % 13 == 0)
            after[i].radius = 0.0f;
    }
    before.resize(kRows - 100); // the last ones have no row yet
    for (uint32_t i = kRows - 100; i < kRows; ++i)
        after[i].age = float(kSeconds) * uniform(random);
    auto older = emptySnapshot(1.0);
    auto newer = emptySnapshot(1.0 + kSeconds);
    const auto& olderGroup = addParticles(older, before);
    const auto& newerGroup = addParticles(newer, after);
    for (const float share : {0.0f, 0.3f, 1.0f}) {
        const Packed packedOlder = pack(olderGroup);
        const auto expected = read(pack(newerGroup), &packedOlder, share);
        Packed mixed = pack(newerGroup);
        render::packRowsBetween(newerGroup, olderGroup, {share, float(kSeconds)}, 0, 700, mixed.places,
                                mixed.bytes.data());
        render::packRowsBetween(newerGroup, olderGroup, {share, float(kSeconds)}, 700, kRows - 700,
                                mixed.places, mixed.bytes.data());
        const auto reads = read(mixed);
        uint32_t alive = 0;
        for (uint32_t i = 0; i < kRows; ++i) {
            const float back = (1.0f - share) * float(kSeconds);
            if (std::abs(after[i].age - back) < 1.0f / 2048.0f)
                continue; // ages are rounded
            ASSERT_EQ(reads[i].velocity.w, expected[i].velocity.w) << i << " at " << share;
            if (expected[i].velocity.w == 0.0f)
                continue;
            ++alive;
            const float speed = largest(after[i].velocity);
            const float room = 0.004f * speed * float(kSeconds) + 4e-6f * largest(after[i].center);
            ASSERT_LE(largest(glm::vec3(reads[i].center) - glm::vec3(expected[i].center)), room) << i;
            ASSERT_NEAR(reads[i].center.w, expected[i].center.w, expected[i].center.w / 2000.0f);
            ASSERT_LE(largest(glm::vec3(reads[i].velocity) - glm::vec3(expected[i].velocity)),
                      speed / 100.0f);
            ASSERT_NEAR(reads[i].color.a, expected[i].color.a, 1e-3f);
            ASSERT_LE(turnBetween(reads[i].turned.x, expected[i].turned.x), 2.0 * std::numbers::pi / 4096.0);
            ASSERT_NEAR(reads[i].turned.y, expected[i].turned.y, 1e-4f) << i;
            ASSERT_NEAR(std::abs(glm::dot(reads[i].orientation, expected[i].orientation)), 1.0f, 1e-4f);
        }
        EXPECT_GT(alive, kRows / 2);
    }
}
