/// @file link_client.h
/// The client's end of a live link.
///
/// Threads: one at a time.
#pragma once

#include "fxsdk/livelink/protocol/link_message.h"
#include "fxsdk/livelink/protocol/link_socket.h"
#include "fxsdk/livelink/protocol/message_frame.h"

#include <deque>
#include <memory>
#include <string>

namespace fx::link {

class LinkClient
{
public:
    /// Connects and sends the hello. @return NotFound if no process accepts connections at the address, or Io
    static base::Result<std::unique_ptr<LinkClient>> connect(const Address& address,
                                                             const std::string& token);

    /// Queues a message. @return TooLarge: the game does not accept messages of this length
    base::Status send(const nlohmann::json& message);
    /// Writes and reads what is possible without waiting. @return Io: the connection has ended; messages that
    /// have arrived before can still be taken
    base::Status update();
    /// Takes a message of the game; null: none has arrived.
    nlohmann::json take();
    /// Waits for a message. @return Interrupted after `seconds` [s] without one, Io
    base::Result<nlohmann::json> wait(double seconds);
    /// Waits for the reply to the hello. @return InvalidArgument with the words of a game that refuses the
    /// client
    base::Result<nlohmann::json> waitForHello(double seconds);
    /// Name of the game, after its hello.
    const std::string& game() const { return game_; }

private:
    explicit LinkClient(Socket socket) : socket_(std::move(socket)) {}
    base::Status receive();
    void note(const nlohmann::json& message);

    Socket socket_;
    FrameReader reader_{kLargestMessage};
    std::string out_;
    std::deque<nlohmann::json> messages_;
    std::string game_;
    uint64_t longest_ = kLargestMessage; ///< [byte] message that the game accepts
};

/// Asks a game for its presets and instances, within `seconds` [s]. @return an error with the words of the
/// game
base::Result<nlohmann::json> askForList(const Address& address, const std::string& token, double seconds);

} // namespace fx::link
