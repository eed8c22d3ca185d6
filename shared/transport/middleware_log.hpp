#pragma once

namespace cosight::transport {

/// Fast DDS's own warnings and errors become log lines of the program instead of text on standard output.
void route_middleware_log();

}  // namespace cosight::transport
