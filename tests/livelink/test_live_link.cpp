// A game with a live link, over real sockets.
#include "tests/livelink/link_fixture.h"

#include <filesystem>
#include <string>
#include <thread>

using namespace fx::test;
using namespace fx::link;

namespace {

constexpr const char* kToken = "0123456789abcdef";

} // namespace

TEST_F(LinkTest, listsPresetsAndInstances)
{
    open();
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = edited_;
    def.position[0] = 5;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    (void)addFountain();
    (void)addFountain();
    auto client = greeted();
    EXPECT_EQ(client->game(), "test-game");
    ASSERT_TRUE(client->send({{"type", "list"}, {"id", 3}}).ok());
    const nlohmann::json list = reply(*client);
    EXPECT_EQ(list["type"], "list");
    EXPECT_EQ(list["id"], 3);
    ASSERT_EQ(list["presets"].size(), 2u);
    EXPECT_EQ(list["presets"][1]["source"], kFountainFile);
    EXPECT_EQ(list["presets"][1]["name"], "edited fountain");
    EXPECT_EQ(list["presets"][1]["instances"], 1);
    EXPECT_EQ(list["presets"][0]["instances"], 2);
    EXPECT_EQ(list["instanceCount"], 3);
    EXPECT_EQ(list["instances"][0]["preset"], 1);
    EXPECT_EQ(list["instances"][0]["position"][0], 5.0);
    EXPECT_EQ(list["instances"][0]["state"], "active");
    EXPECT_GT(list["instances"][0]["particles"], 0);
}

TEST_F(LinkTest, anEditIsShownUnderTheLivingInstance)
{
    open();
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = edited_;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    auto client = greeted();
    play(60);
    const double before = meanHeight();
    EXPECT_NEAR(before, 1.0, 0.5);
    ASSERT_TRUE(
        client->send(replaceMessage(9, "/home/user/game/fx/fountain.fx.json", fountainAt(20), false)).ok());
    const nlohmann::json done = reply(*client);
    EXPECT_EQ(done["type"], "replaced") << done.dump();
    EXPECT_EQ(done["id"], 9);
    EXPECT_EQ(done["preset"], kFountainFile);
    EXPECT_EQ(done["instances"], 1);
    EXPECT_GE(done["frames"], 1);
    EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
    EXPECT_NEAR(meanHeight(), 20.0, 0.5);

    // What the game creates afterwards has the edited preset as well, and no id is left behind.
    FxInstanceId later{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &later), FX_OK);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    play(30);
    EXPECT_NEAR(meanHeight(), 20.0, 0.5);
    uint32_t count = 0;
    EXPECT_EQ(fxGetPresets(context_, nullptr, 0, &count), FX_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(linkStatistics().replacements, 1u);
}

TEST_F(LinkTest, aPausedGameShowsAnEditToo)
{
    open();
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = edited_;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    auto client = greeted();
    play(60);
    ASSERT_TRUE(client->send(replaceMessage(1, "edited fountain", fountainAt(7), false)).ok());
    EXPECT_EQ(reply(*client, 0.0)["type"], "replaced");
    EXPECT_NEAR(meanHeight(), 7.0, 0.5);
}

TEST_F(LinkTest, anInvalidTextGetsTheFindingsAndChangesNothing)
{
    open();
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = edited_;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    auto client = greeted();
    play(20);
    const uint64_t before = simulationHash();
    std::string text = fountainAt(3);
    text.insert(1, "\n\"bogus\": 1, ");
    ASSERT_TRUE(client->send(replaceMessage(4, kFountainFile, text, false)).ok());
    const nlohmann::json refused = reply(*client, 0.0);
    EXPECT_EQ(refused["type"], "error");
    EXPECT_EQ(refused["id"], 4);
    EXPECT_EQ(refused["code"], "schema");
    const std::string message = refused["message"];
    EXPECT_NE(message.find("fountain.fx.json:2"), std::string::npos) << message;
    EXPECT_NE(message.find("bogus"), std::string::npos) << message;
    ASSERT_TRUE(client->send(replaceMessage(5, "rain.fx.json", fountainAt(3), false)).ok());
    EXPECT_EQ(reply(*client, 0.0)["code"], "not-found");
    EXPECT_EQ(simulationHash(), before);
    EXPECT_EQ(linkStatistics().errors, 2u);
    ASSERT_TRUE(client->send({{"type", "list"}, {"id", 6}}).ok());
    EXPECT_EQ(reply(*client)["type"], "list"); // the connection lives
}

TEST_F(LinkTest, presetsCanBeLoadedWithinTheUpdate)
{
    open([](FxLiveLinkDef& def) { def.flags = FX_LIVELINK_LOAD_ON_UPDATE; });
    auto client = greeted();
    ASSERT_TRUE(client->send(replaceMessage(1, kFountainFile, fountainAt(7), true)).ok());
    const nlohmann::json done = reply(*client);
    EXPECT_EQ(done["type"], "replaced");
    EXPECT_EQ(done["frames"], 1);
    EXPECT_EQ(done["instances"], 0);
}

TEST_F(LinkTest, aSecondClientIsRefusedWithWordsAndTheFirstStays)
{
    open();
    auto first = greeted();
    auto second = connect();
    const nlohmann::json refused = reply(*second);
    EXPECT_EQ(refused["type"], "error");
    EXPECT_EQ(refused["code"], "busy");
    EXPECT_TRUE(reply(*second).is_null()); // closed
    ASSERT_TRUE(first->send({{"type", "list"}, {"id", 1}}).ok());
    EXPECT_EQ(reply(*first)["type"], "list");
    first.reset();
    frame();
    EXPECT_EQ(linkStatistics().hasClient, 0u);
    (void)greeted(); // the place is free again
}

TEST_F(LinkTest, tcpNeedsTheToken)
{
    FxLiveLinkDef def = defaultDef();
    def.flags = FX_LIVELINK_TCP;
    EXPECT_EQ(fxCreateLiveLink(context_, &def, &link_), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLiveLinkErrorMessage()).find("token"), std::string::npos);
    open([](FxLiveLinkDef& tcp) {
        tcp.flags = FX_LIVELINK_TCP;
        tcp.token = kToken;
    });
    EXPECT_TRUE(address().isTcp());
    for (const std::string& wrong :
         {std::string(), std::string("0123456789abcdeF"), std::string(kToken) + "0"}) {
        auto stranger = connect(wrong);
        const nlohmann::json refused = reply(*stranger);
        EXPECT_EQ(refused["code"], "token");
        EXPECT_TRUE(reply(*stranger).is_null());
    }
    (void)greeted(kToken);
}

TEST_F(LinkTest, theFirstMessageIsAShortHelloOfThisProtocol)
{
    open();
    for (const nlohmann::json& message :
         {nlohmann::json{{"type", "list"}, {"id", 1}}, nlohmann::json{{"type", "hello"}, {"protocol", 2}},
          nlohmann::json{{"type", "hello"}, {"protocol", 1}, {"token", std::string(5000, 'a')}}})
    {
        auto socket = Socket::connect(address());
        ASSERT_TRUE(socket.ok());
        ASSERT_TRUE(socket->send(frameOf(textOf(message))).ok());
        FrameReader reader(kLargestMessage);
        std::optional<std::string> answer;
        bool isClosed = false;
        for (int i = 0; i < 1000 && !isClosed; ++i) {
            frame();
            char bytes[4096];
            const auto count = socket->receive(bytes, sizeof bytes);
            isClosed = !count.ok();
            if (count)
                reader.add({bytes, *count});
            if (!answer)
                answer = *reader.take();
        }
        EXPECT_TRUE(isClosed);
        ASSERT_TRUE(answer);
        EXPECT_EQ((*parseReply(*answer))["type"], "error") << *answer;
    }
}

TEST_F(LinkTest, anUpdateReadsNoMoreThanItMay)
{
    open([](FxLiveLinkDef& def) {
        def.bytesPerUpdate = 4096;
        def.messagesPerUpdate = 1;
        def.maxMessageBytes = 1u << 20;
    });
    auto client = greeted();
    const uint64_t updatesBytes = linkStatistics().bytesRead;
    std::string text = fountainAt(9);
    text.append(100'000, ' ');
    ASSERT_TRUE(client->send(replaceMessage(1, kFountainFile, text, false)).ok());
    ASSERT_TRUE(client->update().ok());
    frame();
    const uint64_t once = linkStatistics().bytesRead - updatesBytes;
    EXPECT_GT(once, 0u);
    EXPECT_LE(once, 4096u);
    EXPECT_EQ(reply(*client)["type"], "replaced");
    EXPECT_EQ(client->send(replaceMessage(2, kFountainFile, std::string(1u << 20, ' '), false)).code(),
              fx::base::Code::TooLarge); // the game has stated its limit
}

TEST_F(LinkTest, aMessageMayComeByteByByte)
{
    open();
    auto socket = Socket::connect(address());
    ASSERT_TRUE(socket.ok());
    const std::string bytes = frameOf(textOf(helloMessage(""))) + frameOf(R"({"type": "list", "id": 5})");
    for (const char byte : bytes) {
        ASSERT_EQ(*socket->send({&byte, 1}), 1u);
        frame();
    }
    FrameReader reader(kLargestMessage);
    std::string types;
    for (int i = 0; i < 2000 && types != "hello list "; ++i) {
        char chunk[4096];
        if (const auto count = socket->receive(chunk, sizeof chunk))
            reader.add({chunk, *count});
        if (const auto message = reader.take(); message.ok() && *message)
            types += std::string((*parseReply(**message))["type"]) + " ";
        frame();
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(types, "hello list ");
}

TEST_F(LinkTest, aFaultyDefinitionIsRefused)
{
    FxLiveLink* link = nullptr;
    FxLiveLinkDef def = defaultDef();
    EXPECT_EQ(fxCreateLiveLink(nullptr, &def, &link), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateLiveLink(context_, nullptr, &link), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateLiveLink(context_, &def, nullptr), FX_ERROR_INVALID_ARGUMENT);
    const auto refused = [&](auto&& change) {
        FxLiveLinkDef wrong = defaultDef();
        change(wrong);
        return fxCreateLiveLink(context_, &wrong, &link);
    };
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.structSize = 4; }), FX_ERROR_VERSION);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.structSize = sizeof d + 8; }), FX_ERROR_VERSION);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.name = nullptr; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.name = "a/b"; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.flags = 4; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.token = "short"; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.port = 65536; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.bytesPerUpdate = 0; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.maxMessageBytes = (1u << 26) + 1; }),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.messagesPerUpdate = 0; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.reserved = 1; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxLiveLinkDef& d) { d.socketPath = "/no-such-folder/a.sock"; }), FX_ERROR_IO);
    EXPECT_EQ(link, nullptr);
    EXPECT_EQ(fxLiveLink_Update(nullptr, nullptr, 0), FX_ERROR_INVALID_ARGUMENT);
    open();
    EXPECT_EQ(fxLiveLink_Update(link_, nullptr, 1), FX_ERROR_INVALID_ARGUMENT);
    FxScene* none = nullptr;
    EXPECT_EQ(fxLiveLink_Update(link_, &none, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLiveLink_Update(link_, nullptr, 0), FX_OK);
    char text[4];
    size_t size = 0;
    EXPECT_EQ(fxLiveLink_GetAddress(link_, text, sizeof text, &size), FX_ERROR_CAPACITY);
    FxLiveLinkStatistics statistics{};
    EXPECT_EQ(fxLiveLink_GetStatistics(link_, &statistics), FX_ERROR_VERSION);
    FxLiveLink* second = nullptr; // the file is in use
    EXPECT_EQ(fxCreateLiveLink(context_, &def, &second), FX_ERROR_IO);
}

TEST_F(LinkTest, theSocketGoesWithTheLinkAlsoWithWorkInHand)
{
    open();
    auto client = greeted();
    ASSERT_TRUE(client->send(replaceMessage(1, kFountainFile, fountainAt(7), false)).ok());
    ASSERT_TRUE(client->update().ok());
    frame();
    EXPECT_TRUE(std::filesystem::exists(socketPath_));
    fxDestroyLiveLink(link_);
    link_ = nullptr;
    EXPECT_FALSE(std::filesystem::exists(socketPath_));
    uint32_t count = 0;
    EXPECT_EQ(fxGetPresets(context_, nullptr, 0, &count), FX_OK);
    EXPECT_EQ(count, 2u);
    fxDestroyLiveLink(nullptr);
}

TEST_F(LinkTest, allScenesShowAnEditOrNone)
{
    open();
    FxScene* other = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = edited_;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instance, &id), FX_OK);
    ASSERT_EQ(fxScene_CreateInstance(other, &instance, &id), FX_OK);
    play(10);
    auto client = greeted();
    std::thread([other] {
        EXPECT_EQ(fxScene_AdoptThread(other), FX_OK);
    }).join(); // a scene of another thread
    FxScene* const both[2] = {scene_, other};
    const uint64_t before = simulationHash();
    ASSERT_TRUE(client->send(replaceMessage(1, kFountainFile, fountainAt(7), false)).ok());
    nlohmann::json answer;
    for (int i = 0; i < 5000 && answer.is_null(); ++i) {
        ASSERT_TRUE(client->update().ok());
        ASSERT_EQ(fxLiveLink_Update(link_, both, 2), FX_OK);
        answer = client->take();
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(answer["code"], "wrong-thread") << answer.dump();
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    FxInstanceInfo info{};
    info.structSize = sizeof info;
    FxInstanceId first{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(scene_, &first, 1, &count), FX_OK);
    EXPECT_EQ(fxScene_GetInstanceInfo(scene_, first, &info), FX_OK);
    EXPECT_EQ(info.preset.bits, edited_.bits); // as before
    EXPECT_NE(before, 0u);
    ASSERT_EQ(fxScene_AdoptThread(other), FX_OK);
    ASSERT_EQ(fxScene_ReplacePreset(other, edited_, edited_, FX_REPLACE_SEEK, nullptr), FX_OK);
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(client->send(replaceMessage(2, kFountainFile, fountainAt(8), false)).ok());
        answer = nullptr;
        for (int j = 0; j < 5000 && answer.is_null(); ++j) {
            ASSERT_TRUE(client->update().ok());
            ASSERT_EQ(fxLiveLink_Update(link_, both, 2), FX_OK);
            answer = client->take();
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        EXPECT_EQ(answer["instances"], 2) << answer.dump();
    }
}
