#include "tests/livelink/link_fixture.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace fx::test {

LinkFolder::LinkFolder()
{
    std::string name = (std::filesystem::temp_directory_path() / "fx-link-XXXXXX").string();
    path_ = mkdtemp(name.data());
}

LinkFolder::~LinkFolder()
{
    std::error_code error;
    std::filesystem::remove_all(path_, error);
}

std::string fountainAt(double y)
{
    return R"({"version": 1, "name": "edited fountain", "ground": false, "emitters": [{
        "maxParticles": 200, "position": [0, )" +
           std::to_string(y) +
           R"(, 0], "emission": {"rate": 60}, "lifetime": 2, "speed": 0.5, "radius": 0.1,
        "forces": {"gravity": 0}}]})";
}

LinkTest::LinkTest() : socketPath_(folder_.path() + "/game.sock")
{
    const std::string text = fountainAt(1);
    EXPECT_EQ(fxLoadPresetText(context_, text.c_str(), text.size(), kFountainFile, &edited_), FX_OK)
        << fxGetLastErrorMessage();
}

LinkTest::~LinkTest()
{
    fxDestroyLiveLink(link_);
}

FxLiveLinkDef LinkTest::defaultDef() const
{
    FxLiveLinkDef def = fxDefaultLiveLinkDef();
    def.name = "test-game";
    def.socketPath = socketPath_.c_str();
    return def;
}

link::Address LinkTest::address() const
{
    char text[256];
    size_t size = 0;
    EXPECT_EQ(fxLiveLink_GetAddress(link_, text, sizeof text, &size), FX_OK);
    const auto address = link::parseAddress(text);
    EXPECT_TRUE(address.ok()) << text;
    return *address;
}

void LinkTest::frame(double seconds) const
{
    ASSERT_EQ(fxLiveLink_Update(link_, &scene_, 1), FX_OK) << fxGetLiveLinkErrorMessage();
    ASSERT_EQ(fxScene_Update(scene_, seconds), FX_OK) << fxGetLastErrorMessage();
}

std::unique_ptr<link::LinkClient> LinkTest::connect(const std::string& token) const
{
    auto client = link::LinkClient::connect(address(), token);
    EXPECT_TRUE(client.ok()) << client.status().message();
    return client ? std::move(*client) : nullptr;
}

std::unique_ptr<link::LinkClient> LinkTest::greeted(const std::string& token) const
{
    auto client = connect(token);
    const nlohmann::json hello = reply(*client);
    EXPECT_EQ(hello.value("type", ""), "hello") << hello.dump();
    return client;
}

nlohmann::json LinkTest::reply(link::LinkClient& client, double seconds) const
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
        const base::Status status = client.update();
        if (nlohmann::json message = client.take(); !message.is_null())
            return message;
        if (!status)
            return {};
        frame(seconds);
        std::this_thread::sleep_for(std::chrono::microseconds(200)); // the worker may need the processor
    }
    ADD_FAILURE() << "no reply";
    return {};
}

FxLiveLinkStatistics LinkTest::linkStatistics() const
{
    FxLiveLinkStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxLiveLink_GetStatistics(link_, &statistics), FX_OK);
    return statistics;
}

double LinkTest::meanHeight() const
{
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene_, snapshot, &info), FX_OK);
    double sum = 0;
    uint32_t count = 0;
    for (uint32_t g = 0; g < info.groupsNewer; ++g) {
        FxSnapshotColumn y{}, radius{};
        y.structSize = radius.structSize = sizeof y;
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, g, "y", &y), FX_OK);
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, g, "radius", &radius),
                  FX_OK);
        for (uint32_t i = 0; i < y.count; ++i)
            if (radius.values[i] > 0) {
                sum += double(y.values[i]);
                ++count;
            }
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
    return count > 0 ? sum / count : 0.0;
}

} // namespace fx::test
