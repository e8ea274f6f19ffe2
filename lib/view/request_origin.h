// Which requests come from the page that a server itself serves. A page of another site can make a browser
// send requests here; its name in the request gives it away.
#pragma once

#include <optional>
#include <string_view>

namespace phos::inline view {

/// Does a Host header name this server: a numeric address, localhost, or the name that it was told to serve?
/// The port is left out, as tunnels change it. Any other name is one that somebody else has made to lead here
/// (DNS rebinding). An empty header does not.
bool names_this_server(std::string_view host_header, std::string_view served_host);

/// May a page of this Origin header open a WebSocket? Browsers send the header always, other programs need
/// not. It must be "http://" and the Host header.
bool is_same_origin(std::optional<std::string_view> origin_header, std::string_view host_header);

}  // namespace phos::inline view
