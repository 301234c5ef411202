/// @file live_edit.h
/// Sends the newest text of a preset to a running game: one text at a time, and of those that come meanwhile
/// only the last. A lost connection is made again.
///
/// Threads: one at a time.
#pragma once

#include "fxsdk/livelink/client/link_client.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace fx::link {

enum class LinkState
{
    Off,
    Connecting, ///< also while a lost connection is made again
    Connected,
};

/// The last reply to a text.
struct Outcome
{
    uint64_t revision = 0;   ///< of the text; 0: none
    bool isShown = false;    ///< the game shows the text
    std::string message;     ///< what the game says, for people
    uint64_t instances = 0;  ///< that show it
    uint64_t frames = 0;     ///< of the game until it showed the text, see fx_livelink.h
    double milliseconds = 0; ///< [ms] from sending to the reply
};

class LiveEdit
{
public:
    /// Begins to connect. @param preset name of the preset in the game
    void start(const Address& address, const std::string& token, const std::string& preset);
    void stop();

    /// States the text that the game shall show.
    /// @param revision differs from that of other texts, not 0
    void offer(std::string text, uint64_t revision);
    /// Sends, receives and connects, without waiting. @param seconds [s] real time since the last call
    void update(double seconds);

    LinkState state() const { return state_; }
    const std::string& message() const
    {
        return message_;
    } ///< why there is no connection; empty: there is one
    const Address& address() const { return address_; }
    const std::string& preset() const { return preset_; }
    std::string game() const { return client_ ? client_->game() : std::string(); }
    const Outcome& outcome() const { return outcome_; }
    bool isBusy() const { return inFlight_ != 0 || offered_.has_value(); }
    const nlohmann::json& list() const { return list_; }  ///< last list of the game; null: none
    uint64_t connections() const { return connections_; } ///< number of hellos of games

private:
    struct Text
    {
        std::string text;
        uint64_t revision = 0;
    };
    void connect();
    void lose(const std::string& why);
    void take(const nlohmann::json& message);
    void sendNewest();
    void askList(double seconds);

    LinkState state_ = LinkState::Off;
    Address address_;
    std::string token_;
    std::string preset_;
    std::string message_;
    std::unique_ptr<LinkClient> client_;
    std::optional<Text> offered_; ///< newest text that is not sent
    std::optional<Text> sent_;    ///< last text that was sent, for a new connection
    uint64_t inFlight_ = 0;       ///< number of the request without reply; 0: none
    uint64_t listRequest_ = 0;
    uint64_t requests_ = 0;
    double untilRetry_ = 0; ///< [s]
    double untilList_ = 0;  ///< [s]
    double flight_ = 0;     ///< [s] time since sending
    uint64_t connections_ = 0;
    Outcome outcome_;
    nlohmann::json list_;
};

} // namespace fx::link
