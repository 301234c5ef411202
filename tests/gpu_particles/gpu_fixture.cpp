#include "gpu_fixture.h"

#include "foundation/snapshot/particle_kind.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/techniques.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/passes/scene_distance_pass.h"

#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include <cstring>

namespace fx::test {

namespace column = base::particle_column;

std::string libraryText(const std::string& name, const char* compute)
{
    for (const base::EmbeddedText& text : preset::presetLibrary()) {
        if (text.name != name)
            continue;
        auto document = nlohmann::json::parse(text.text);
        for (auto& emitter : document["emitters"])
            emitter["compute"] = compute;
        return document.dump();
    }
    return {};
}

std::vector<std::string> libraryNames()
{
    std::vector<std::string> names;
    for (const base::EmbeddedText& text : preset::presetLibrary()) {
        const auto document = nlohmann::json::parse(text.text);
        if (document.contains("emitters") && (FXSDK_WITH_SPH || !document.contains("gas")))
            names.emplace_back(text.name);
    }
    return names;
}

OneEffect::OneEffect(const base::SnapshotSchema& schema, std::shared_ptr<const sim::EffectDef> effect,
                     bool onGpu, uint64_t seed, const base::Placement& place)
    : schema_(schema), world_(&schema, tasks_.get(), std::pmr::get_default_resource())
{
    world_.setGpuParticles(onGpu);
    sim::InstanceStart start;
    start.instance = 1;
    start.seed = seed;
    start.placement = place;
    slot_ = world_.add(std::move(effect), start);
}

void OneEffect::playTo(double seconds, double step)
{
    const base::Ticks end = base::toTicks(seconds);
    const base::Ticks ticks = base::toTicks(step);
    for (; now_ < end; now_ += ticks)
        world_.step({&slot_, 1}, now_, ticks);
}

void OneEffect::seekTo(double seconds)
{
    sim::StepCounters counters;
    world_.seekTo(slot_, base::toTicks(seconds), kStep, counters);
}

const base::FrameSnapshot& OneEffect::publish()
{
    older_ = std::move(snapshot_);
    snapshot_ = std::make_unique<base::FrameSnapshot>(&schema_, std::pmr::get_default_resource());
    snapshot_->begin(now_, ++sequence_);
    world_.publish({&slot_, 1}, *snapshot_);
    return *snapshot_;
}

Rows rowsOf(const base::SnapshotGroup& group)
{
    Rows rows;
    rows.columns.resize(column::Count);
    for (size_t c = 0; c < column::Count; ++c)
        if (c != column::Color && c != column::Index && group.has(c))
            rows.columns[c].assign(group.column(c).begin(), group.column(c).end());
    for (const uint64_t color : group.column64(column::Color))
        rows.color.push_back(glm::unpackHalf4x16(color));
    return rows;
}

void GpuParticleTest::SetUp()
{
    ViewTest::SetUp();
    preset::registerKinds(schema_);
    graph_ = std::make_unique<render::FrameGraph>(std::pmr::get_default_resource());
    backend_ = std::make_unique<render::GlBackend>(*device_, std::pmr::get_default_resource());
    emitters_ = std::make_unique<render::GpuEmitters>(*device_, std::pmr::get_default_resource());
    states_ = makeStates();
    view_->setAssets(&assets_);
    view_->settings().exposureEv100 = 12.0f;
    view_->settings().lighting.skyLuminance = glm::vec3(2000.0f);
}

base::Status GpuParticleTest::drawInto(const base::FrameSnapshot& newer, const base::FrameSnapshot* older)
{
    render::FrameRequest request;
    request.camera = render::perspectiveView({{1.0, 2.5, 11.0}, {0.0, 2.0, 0.0}}, 0.9f, 1.0f, 0.1f);
    if (depthCamera_) {
        request.camera = *depthCamera_;
        request.targets.depth = depth_->name();
    }
    request.targets.color = color_->name();
    request.targets.width = color_->width();
    request.targets.height = color_->height();
    request.interpolation = 0.5;
    return view_->render({&newer, older}, request);
}

Picture GpuParticleTest::draw(const base::FrameSnapshot& newer, const base::FrameSnapshot* older)
{
    setPicture(std::vector<float>(size_t(color_->width()) * size_t(color_->height()) * 4, 0.0f));
    const base::Status status = drawInto(newer, older);
    EXPECT_TRUE(status.ok()) << status.message();
    return read(color_->name());
}

void GpuParticleTest::TearDown()
{
    states_.reset();
    emitters_.reset();
    backend_.reset();
    graph_.reset();
    ViewTest::TearDown();
}

std::shared_ptr<const sim::EffectDef> GpuParticleTest::load(const std::string& text)
{
    auto preset = preset::loadPresetText(text, "test", nullptr, nullptr, {&assets_});
    EXPECT_TRUE(preset.ok()) << preset.status().message();
    return preset->effect;
}

render::GpuDepth GpuParticleTest::seenDepth()
{
    if (!depthCamera_)
        return {};
    const int width = depth_->width(), height = depth_->height();
    const render::ResourceId depth =
        graph_->importTexture({"host depth", width, height, render::Format::R32F}, depth_->name());
    const render::ViewBlock view = render::makeViewBlock(*depthCamera_, width, height);
    return {render::SceneDistancePass::addTo(*graph_, {depth, width, height, view}).distance, &*depthCamera_,
            width, height};
}

Rows GpuParticleTest::computed(const base::SnapshotGroup& group, render::GpuStates& states)
{
    const auto& features = group.program()->features;
    const uint32_t count = group.program()->rows;
    std::array<int32_t, 16> at;
    at.fill(-1);
    int32_t words = 0;
    for (size_t c = 0; c < column::Count; ++c)
        if ((features.columns >> c & 1) != 0) {
            at[c] = words;
            words += int32_t(count) * (c == column::Color ? 2 : 1);
        }
    auto entry = emitters_->find(group.program());
    EXPECT_TRUE(entry.ok()) << entry.status().message();
    auto in = render::GlBuffer::create(*device_, group.column64(0).size_bytes(), "words");
    auto out = render::GlBuffer::create(*device_, size_t(words) * 4, "rows");
    device_->gl.NamedBufferSubData(in->name(), 0, GLsizeiptr(in->bytes()), group.column64(0).data());
    render::ParticleBatch batch{};
    batch.newer = {out->name(), {}, 0, out->bytes()};
    render::GpuRowsJob job{(*entry)->program,
                           0,
                           true,
                           {(*entry)->numbers.name(), {}, 0, (*entry)->numbers.bytes()},
                           {in->name(), {}, 0, in->bytes()},
                           at,
                           count};
    job.meetsDepth = render::meetsDepth(group.program()->features);
    job.place = group.info().placement;
    states.nextFrame();
    const base::Status prepared = states.prepare(group, job);
    EXPECT_TRUE(prepared.ok()) << prepared.message();
    steps_ = job.stepCount;
    graph_->begin();
    batch.newer.id = graph_->importBuffer({"rows", out->bytes()}, out->name());
    render::GpuRowsPass::addTo(*graph_, {&job, 1}, {&batch, 1}, seenDepth());
    graph_->compile();
    EXPECT_TRUE(backend_->beginFrame(*graph_).ok());
    graph_->execute(*backend_);
    const base::Status status = backend_->endFrame();
    EXPECT_TRUE(status.ok()) << status.message();

    std::vector<uint32_t> read(static_cast<size_t>(words));
    device_->gl.GetNamedBufferSubData(out->name(), 0, GLsizeiptr(out->bytes()), read.data());
    Rows rows;
    rows.columns.resize(column::Count);
    for (size_t c = 0; c < column::Count; ++c) {
        if (at[c] < 0 || c == column::Index)
            continue;
        for (uint32_t row = 0; row < count; ++row) {
            if (c == column::Color) {
                const size_t w = size_t(at[c]) + 2 * row;
                rows.color.push_back(glm::unpackHalf4x16(uint64_t(read[w]) | uint64_t(read[w + 1]) << 32));
            } else {
                float value;
                std::memcpy(&value, &read[size_t(at[c]) + row], sizeof value);
                rows.columns[c].push_back(value);
            }
        }
    }
    return rows;
}

} // namespace fx::test
