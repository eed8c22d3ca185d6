#pragma once

#include <string>

namespace cosight::transport {

/// The IPv4 address of an interface ("eth0"), or `interface` itself when it is one of this host's addresses.
/// Throws TransportError when there is none yet: DDS reads the addresses once, at the participant's creation.
std::string ipv4_of_interface(const std::string& interface);

/// What to tell the user when the kernel refuses `bytes` of socket buffer; empty when it does not.
std::string refused_socket_buffer(int bytes);

}  // namespace cosight::transport
