/// @file link_fixture.h
/// A game with a live link, whose frames a test draws one by one, and a client in the same thread.
#pragma once

#include "fxsdk/fx_livelink.h"
#include "fxsdk/livelink/client/link_client.h"
#include "tests/api/api_fixture.h"

#include <memory>
#include <string>

namespace fx::test {

/// A folder in the temporary folder, which is removed with its files.
class LinkFolder
{
public:
    LinkFolder();
    ~LinkFolder();
    LinkFolder(const LinkFolder&) = delete;
    LinkFolder& operator=(const LinkFolder&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

constexpr const char* kFountainFile = "fx/fountain.fx.json"; ///< source of the preset of LinkTest

/// A fountain whose particles are born at the height `y` [m].
std::string fountainAt(double y);

class LinkTest : public ApiTest
{
protected:
    LinkTest();
    ~LinkTest() override;

    /// Opens the link. @param change changes the definition
    template <class F>
    void open(F&& change)
    {
        FxLiveLinkDef def = defaultDef();
        change(def);
        ASSERT_EQ(fxCreateLiveLink(context_, &def, &link_), FX_OK) << fxGetLiveLinkErrorMessage();
    }
    void open()
    {
        open([](FxLiveLinkDef&) {});
    }
    FxLiveLinkDef defaultDef() const;
    link::Address address() const;
    /// One frame of the game. @param seconds [s] 0: paused
    void frame(double seconds = kFrame) const;
    std::unique_ptr<link::LinkClient> connect(const std::string& token = {}) const;
    /// A client that the game has greeted.
    std::unique_ptr<link::LinkClient> greeted(const std::string& token = {}) const;
    /// Draws frames until a message arrives or the connection ends; null at its end.
    nlohmann::json reply(link::LinkClient& client, double seconds = kFrame) const;
    FxLiveLinkStatistics linkStatistics() const;
    /// Mean local height of the living particles [m], of all instances.
    double meanHeight() const;

    LinkFolder folder_;
    std::string socketPath_;
    FxLiveLink* link_ = nullptr;
    FxPresetId edited_{}; ///< the preset kFountainFile
};

} // namespace fx::test
