/// @file link_socket.h
/// Sockets that never wait.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/livelink/protocol/link_address.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace fx::link {

/// Owns the descriptor of a stream socket, which is non-blocking and closed in child processes.
class Socket
{
public:
    Socket() = default;
    explicit Socket(int descriptor) : descriptor_(descriptor) {}
    ~Socket();
    Socket(Socket&& other) noexcept;
    Socket& operator=(Socket&& other) noexcept;

    /// Opens a listening socket. The file of a Unix socket has mode 0600; the file of a process that has
    /// ended is replaced. @param ioAddress gets the port that was chosen for port 0 @return Io
    static base::Result<Socket> listen(Address& ioAddress);
    /// Connects to a listening socket of this machine. @return Io, NotFound
    static base::Result<Socket> connect(const Address& address);

    /// A connection that waits to be accepted, if there is one. A connection of another user than this one
    /// and the superuser is closed.
    std::optional<Socket> accept(bool isTcp);
    /// Reads up to `size` bytes. @return number of bytes, 0 if none have arrived; Io: the connection has
    /// ended
    base::Result<size_t> receive(char* out, size_t size);
    /// Writes a part of `bytes`. @return number of bytes, 0 if there is no room; Io: the connection has ended
    base::Result<size_t> send(std::string_view bytes);
    /// Waits until bytes have arrived, there is room to write if `writes`, or the time is over.
    void wait(double seconds, bool writes) const;

    bool isOpen() const { return descriptor_ >= 0; }

private:
    int descriptor_ = -1;
};

} // namespace fx::link
