#include "tests/marker/marker_technique.h"

#include "rendering/frame/exposure.h"
#include "rendering/gl/gl_buffer.h"
#include "shaders/shader_library.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <numeric>

namespace fx::test {

namespace {

using namespace render;

constexpr ProgramDesc kProgram{"marker", "marker.vert.glsl", "marker.frag.glsl", nullptr, nullptr};
constexpr const ProgramDesc* kPrograms[] = {&kProgram};
constexpr TimedPass kPasses[] = {
    {"scene distance"}, {"marker upload", "marker"}, {"media", "media"}, {"composite"}};

/// Layout of marker.vert.glsl.
struct Marker
{
    glm::vec4 centerHalf;
    glm::vec4 light;
};

class MarkerSource final : public MediaSource
{
public:
    void read(FrameGraph::Builder& builder) const override { builder.read(markers); }

    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override
    {
        drawQuads(backend, kProgram, {markers}, batch, target);
    }

    ResourceId markers;
};

class MarkerView final : public TechniqueView
{
public:
    explicit MarkerView(const TechniqueSetup& setup)
        : device_(*setup.device), markers_(setup.memory), distances_(setup.memory), order_(setup.memory)
    {}

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override
    {
        isKept_ = false;
        collect(in);
        sort();
        if (markers_.empty())
            return {};
        DrawStream stream;
        stream.count = uint32_t(markers_.size());
        stream.distances = distances_.data();
        stream.order = order_.data();
        stream.source = &source_;
        io.streams->push_back(stream);
        estimate(in, io.fragments);
        const size_t bytes = std::bit_ceil(markers_.size() * sizeof(Marker));
        if (buffer_.bytes() >= bytes)
            return {};
        auto created = GlBuffer::create(device_, bytes, "markers");
        if (!created)
            return created.status();
        buffer_ = std::move(*created);
        return {};
    }

    void keep() override { isKept_ = true; }

    void addPasses(PassStage stage, FrameGraph& graph, PassFrame&) override
    {
        if (stage != PassStage::Upload || markers_.empty())
            return;
        source_.markers = graph.importBuffer({"markers", buffer_.bytes()}, buffer_.name());
        if (isKept_)
            return;
        graph.addPass("marker upload", [&](FrameGraph::Builder& builder) {
            source_.markers = builder.write(source_.markers);
            return [buffer = source_.markers, markers = std::span<const Marker>(markers_)](Backend& backend) {
                backend.upload(buffer, std::as_bytes(markers));
            };
        });
    }

    void rest() override { buffer_ = {}; }
    void count(FrameStatistics& statistics) const override { statistics.particles += markers_.size(); }
    uint64_t bytes() const override { return buffer_.bytes(); }

private:
    void collect(const GatherInputs& in)
    {
        markers_.clear();
        if (!in.snapshots->newer)
            return;
        const base::FrameSnapshot& snapshot = *in.snapshots->newer;
        const base::KindId kind = snapshot.schema().find(kMarkerKind.name);
        const float exposure = exposureFromEv100(in.settings->exposureEv100);
        for (size_t g = 0; g < snapshot.groupCount(); ++g) {
            if (snapshot.name(g).kind != kind)
                continue;
            const base::SnapshotGroup& group = snapshot.group(g);
            const auto c = group.constants();
            const glm::vec3 place(group.info().placement.position - in.camera->eye);
            for (size_t i = 0; i < group.count(); ++i) {
                const glm::vec3 center =
                    place + glm::vec3(group.column(0)[i], group.column(1)[i], group.column(2)[i]);
                markers_.push_back({{center, c[0]}, {glm::vec3(c[1], c[2], c[3]) * exposure, 1.0f}});
            }
        }
    }

    void sort()
    {
        std::ranges::stable_sort(markers_, [](const Marker& a, const Marker& b) {
            return glm::length(glm::vec3(a.centerHalf)) > glm::length(glm::vec3(b.centerHalf));
        });
        order_.resize(markers_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        distances_.clear();
        for (const Marker& marker : markers_)
            distances_.push_back(glm::length(glm::vec3(marker.centerHalf)));
    }

    void estimate(const GatherInputs& in, FragmentCounts& io) const
    {
        const float perSlope = 0.5f * float(in.request->targets.height) * std::abs(in.camera->clipScale.y);
        for (const Marker& marker : markers_) {
            const float side =
                2.0f * marker.centerHalf.w * perSlope / glm::length(glm::vec3(marker.centerHalf));
            for (size_t i = 0; i < io.size(); ++i)
                io[i] += uint64_t(side * side) / uint64_t(kLayerDivisors[i] * kLayerDivisors[i]);
        }
    }

    GlDevice& device_;
    std::pmr::vector<Marker> markers_; ///< farthest first
    std::pmr::vector<float> distances_;
    std::pmr::vector<uint32_t> order_;
    MarkerSource source_;
    GlBuffer buffer_;
    bool isKept_ = false;
};

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<MarkerView>(setup);
}

std::span<const ProgramDesc* const> programs()
{
    return kPrograms;
}

} // namespace

constexpr render::DrawTechnique kMarkerTechnique{
    .name = "markers",
    .kind = &kMarkerKind,
    .create = create,
    .programs = programs,
    .passes = kPasses,
};

std::optional<std::string> markerSource(std::string_view name, std::string_view defines)
{
    if (!name.starts_with("marker."))
        return {};
    std::ifstream file(std::string(FX_SOURCE_DIR "/tests/marker/").append(name));
    auto text = shaders::assemble("shared/view_block.glsl", defines);
    return *text + std::string(std::istreambuf_iterator<char>(file), {});
}

} // namespace fx::test
