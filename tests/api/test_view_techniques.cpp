// What exists because of a technique: programs, textures, buffers and passes, one row a technique.
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "tests/api/api_fixture.h"
#include "tests/api/technique_rows.h"
#include "tests/api/view_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

using namespace fx;

namespace {

constexpr int kSize = 32; ///< [pixel]

using Names = std::vector<std::string>;
using Row = fx::test::TechniqueRow;

/// A host with a picture, a context that has compiled nothing, and a view.
class Host
{
public:
    explicit Host(bool dazzle)
    {
        auto context = render::createEglContext({});
        if (!context)
            throw std::runtime_error(context.status().message());
        gl_ = std::move(*context);
        auto device = render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource());
        host_ = std::move(*device);
        auto color = render::GlTexture::create(*host_, kSize, kSize, GL_RGBA32F, "host");
        color_ = std::move(*color);
        ledger_ = std::make_unique<test::GlLedger>(gl_->loader());
        FxContextDef contextDef = fxDefaultContextDef();
        contextDef.workers = 1;
        contextDef.gl = {ledger_->loader().user, ledger_->loader().getProcAddress};
        EXPECT_EQ(fxCreateContext(&contextDef, &context_), FX_OK) << fxGetLastErrorMessage();
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = dazzle ? 1 : 0;
        EXPECT_EQ(fxCreateView(context_, scene_, &settings, &view_), FX_OK) << fxGetLastErrorMessage();
    }
    ~Host() { EXPECT_EQ(fxDestroyContext(context_), FX_OK) << fxGetLastErrorMessage(); }

    FxPresetId load(const Row& row)
    {
        return test::loadText(context_, R"({"version": 1, "ground": false, )" + row.members + "}");
    }
    void add(const Row& row)
    {
        if (row.members.empty())
            return;
        setWall(row.meetsMesh || wall_);
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = load(row);
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &instances_.emplace_back()), FX_OK)
            << row.name << ": " << fxGetLastErrorMessage();
    }
    /// A triangle that effects collide with.
    void setWall(bool there)
    {
        if (there == wall_)
            return;
        wall_ = there;
        const float corners[9] = {2, -15, -15, 2, 15, -15, 2, 0, 15};
        FxCollisionMesh mesh = fxDefaultCollisionMesh();
        mesh.positions = corners;
        mesh.vertexCount = 3;
        mesh.cellSize = 0.5f;
        EXPECT_EQ(fxScene_SetCollisionMesh(scene_, there ? &mesh : nullptr), FX_OK)
            << fxGetLastErrorMessage();
    }
    uint64_t bytesInUse() const
    {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
        return stats.bytesInUse;
    }
    void clear()
    {
        for (const FxInstanceId id : instances_)
            EXPECT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
        instances_.clear();
        setWall(false);
    }
    /// After a frame of a view, so that the scene may use the GPU.
    void play(int frames)
    {
        draw(1);
        for (int i = 0; i < frames; ++i)
            EXPECT_EQ(fxScene_Update(scene_, test::kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    /// The camera moves on from frame to frame, so that none can show what the last one kept.
    void draw(int frames)
    {
        FxFrameDef def = fx::test::frameBefore(color_.name(), 0, kSize);
        for (int i = 0; i < frames; ++i) {
            def.origin[0] = 1e-4 * ++drawn_;
            EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        }
    }
    /// Ends with a frame right after a step.
    void show()
    {
        play(12);
        draw(2);
        play(1);
        draw(1);
    }
    Names passes() const { return test::passNamesOf(view_); }
    FxViewStatistics statistics() const
    {
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_OK);
        return statistics;
    }
    void warmUp() { EXPECT_EQ(fxContext_WarmUp(context_), FX_OK) << fxGetLastErrorMessage(); }
    const test::GlLedger& ledger() const { return *ledger_; }

private:
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> host_;
    render::GlTexture color_;
    std::unique_ptr<test::GlLedger> ledger_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxView* view_ = nullptr;
    int drawn_ = 0; ///< frames
    bool wall_ = false;
    std::vector<FxInstanceId> instances_;
};

bool isSetting(const Row& row)
{
    return row.members.empty();
}

/// What `row` calls its own may be in `other`.
bool belongs(const Row& row, const Row& other)
{
    return row.name == other.name || other.standsOn == row.name;
}

bool contains(const Names& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the scene of a row is to light. The lighting itself belongs to no technique:
///
/// - A view that draws media or particles holds the list of lights.
/// - A frame that draws media or particles begins with a pass that uploads the list.
/// - Blobs have their light computed, once for each, right after their upload.
/// - Planes of light are filled only where a light casts (no sun and no sky here, so one of an effect) and
///   something takes light from what lies behind it; these two need not come from one technique.
struct PartInLight
{
    bool isLit;  ///< something is drawn that takes light
    bool shines; ///< sheds light that casts
    bool shades; ///< takes light from what lies behind it
};

PartInLight partInLight(const Row& row)
{
    static const std::map<std::string, PartInLight> kParts{
        {"billboard layers", {true, false, true}}, // dust
        {"heat shimmer", {true, true, true}},      // of blobs that glow
        {"trails", {true, false, true}},
        {"sprites", {true, false, true}},
        {"mesh particles", {true, false, true}},
        {"particle lights", {false, true, false}}, // of particles that nothing shows
        {"scene mesh", {false, false, false}},
        {"dazzle", {false, false, false}},
        {"sph gas", {true, true, true}},         // it burns
        {"gpu particles", {true, false, false}}, // rows that the GPU computes cast no shadow
    };
    const auto found = kParts.find(row.name);
    if (found == kParts.end())
        throw std::runtime_error("say what " + row.name + " is to light");
    return found->second;
}

const Names kSlicePasses{"light slice casters", "light slices"};
const std::string kSliceProgram = "light slices";

/// The rows with what lighting adds to the scene of each.
std::vector<Row> litRows()
{
    std::vector<Row> rows = test::techniqueRows();
    for (Row& row : rows) {
        const PartInLight part = partInLight(row);
        if (part.isLit)
            row.buffers["lights"] = 1;
        const auto upload = std::find(row.passes.begin(), row.passes.end(), "blob upload");
        if (upload != row.passes.end()) {
            row.passes.insert(upload + 1, "blob light");
            row.programs.insert("blob light");
            row.buffers["blob lights"] = 1;
        }
        if (row.name == "billboard layers") { // no blobs, no light of blobs
            row.ownPasses.insert("blob light");
            row.ownPrograms.insert("blob light");
        }
        if (part.shines && part.shades) {
            row.passes.insert(row.passes.begin(), kSlicePasses.begin(), kSlicePasses.end());
            row.programs.insert(kSliceProgram);
            row.textures["RG32F"] = 1; // the planes
            // of casters and stacks; passes behind them use these two again
            row.buffers["frame buffer"] = std::max(row.buffers["frame buffer"], 2);
        }
        if (contains(row.passes, "scene distance")) // media or particles are drawn
            row.passes.insert(row.passes.begin(), "light list");
    }
    return rows;
}

} // namespace

TEST(ViewTechniques, aSceneWithNothingButOneHasExactlyWhatItsRowLists)
{
    for (const Row& row : litRows()) {
        Host host(isSetting(row));
        host.add(row);
        host.show();
        EXPECT_EQ(host.passes(), row.passes) << row.name;
        EXPECT_EQ(host.ledger().programs(), row.programs) << row.name;
        EXPECT_EQ(host.ledger().textures(), row.textures) << row.name;
        EXPECT_EQ(host.ledger().buffers(), row.buffers) << row.name;
    }
}

TEST(ViewTechniques, aSceneWithAllButOneHasNothingThatOnlyThatOneCallsForAndEverythingElse)
{
    const std::vector<Row> rows = litRows();
    for (const Row& missing : rows) {
        bool dazzle = false;
        for (const Row& row : rows)
            dazzle = dazzle || (isSetting(row) && &row != &missing);
        Host host(dazzle);
        std::set<std::string> passes, programs;
        bool anyShines = false, anyShades = false;
        for (const Row& row : rows) {
            if (&row == &missing || row.standsOn == missing.name)
                continue;
            host.add(row);
            passes.insert(row.passes.begin(), row.passes.end());
            programs.insert(row.programs.begin(), row.programs.end());
            const PartInLight part = partInLight(row);
            anyShines = anyShines || part.shines;
            anyShades = anyShades || part.shades;
        }
        if (anyShines && anyShades) { // also where no row alone has both: particle lights shine on sprites
            passes.insert(kSlicePasses.begin(), kSlicePasses.end());
            programs.insert(kSliceProgram);
        }
        if (programs.contains("present") && programs.erase("composite (blend)") > 0)
            programs.insert("composite"); // with a pass behind it, it does not blend in place
        host.show();
        const Names executed = host.passes();
        for (const std::string& own : missing.ownPasses)
            EXPECT_FALSE(contains(executed, own)) << missing.name << ": " << own;
        for (const std::string& own : missing.ownPrograms)
            EXPECT_FALSE(host.ledger().programs().contains(own)) << missing.name << ": " << own;
        EXPECT_EQ(std::set<std::string>(executed.begin(), executed.end()), passes) << missing.name;
        EXPECT_EQ(host.ledger().programs(), programs) << missing.name;
    }
}

TEST(ViewTechniques, whatARowCallsItsOwnIsInNoOtherRow) // the control of the test above: the lists can fail
{
    const std::vector<Row> rows = litRows();
    size_t owned = 0;
    for (const Row& row : rows)
        for (const Row& other : rows) {
            for (const std::string& own : row.ownPasses)
                EXPECT_EQ(contains(other.passes, own), belongs(row, other)) << row.name << ": " << own;
            for (const std::string& own : row.ownPrograms)
                EXPECT_EQ(other.programs.contains(own), belongs(row, other)) << row.name << ": " << own;
            owned += row.ownPrograms.size();
        }
    EXPECT_GE(owned, 9 * rows.size());
}

TEST(ViewTechniques, memoryIsGivenBackAfterAWhileAndComesBackWithoutCompiling)
{
    for (const Row& row : litRows()) {
        if (isSetting(row))
            continue; // requested by the host: it is never idle
        Host host(false);
        host.load(row); // programs of particles on the GPU are known by preset
        host.warmUp();
        const size_t programs = host.ledger().programs().size();
        host.add(row);
        host.show();
        EXPECT_EQ(host.ledger().textures(), row.textures) << row.name;
        host.clear();
        host.play(4);
        host.draw(299);
        EXPECT_EQ(host.ledger().buffers().empty(), row.buffers.empty()) << row.name; // not at once
        host.draw(1);
        EXPECT_TRUE(host.ledger().textures().empty()) << row.name;
        EXPECT_TRUE(host.ledger().buffers().empty()) << row.name;
        EXPECT_EQ(host.ledger().framebuffers(), 0u) << row.name;
        EXPECT_EQ(host.statistics().textureBytes, 0u) << row.name;
        host.add(row);
        host.play(12);
        host.draw(1);
        EXPECT_EQ(host.statistics().programsCompiled, 0u) << row.name;
        host.show();
        EXPECT_EQ(host.passes(), row.passes) << row.name;
        EXPECT_EQ(host.ledger().textures(), row.textures) << row.name;
        EXPECT_EQ(host.ledger().buffers(), row.buffers) << row.name;
        EXPECT_EQ(host.ledger().programs().size(), programs) << row.name;
    }
}

TEST(ViewTechniques, whatOneOfSeveralHasHeldIsGivenBackWhileTheOthersGoOn)
{
    const std::vector<Row> rows = litRows();
    const auto find = [&rows](const std::string& name) {
        return *std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
    };
    const Row meshes = find("mesh particles"), billboards = find("billboard layers");
    Host host(false);
    host.add(meshes);
    host.play(12);
    host.draw(3);
    host.clear();
    host.add(billboards);
    host.play(12);
    host.draw(299);
    EXPECT_TRUE(host.ledger().buffers().contains("particle mesh"));
    host.draw(2);
    EXPECT_EQ(host.ledger().buffers(), billboards.buffers);
    EXPECT_EQ(host.ledger().textures(), billboards.textures);
}

TEST(ViewTechniques, theHostsGeometryTakesMemoryWhileItIsThereAndNothingOfGl)
{
    Host host(false);
    host.play(2);
    host.draw(2);
    const uint64_t before = host.bytesInUse();
    host.setWall(true);
    EXPECT_GT(host.bytesInUse(), before + 1000);
    host.play(2);
    host.draw(2);
    EXPECT_TRUE(host.passes().empty());
    EXPECT_TRUE(host.ledger().textures().empty());
    EXPECT_TRUE(host.ledger().buffers().empty());
    EXPECT_TRUE(host.ledger().programs().empty());
    host.setWall(false);
    EXPECT_EQ(host.bytesInUse(), before);
}
