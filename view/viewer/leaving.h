// What has to be asked before it is done, because something would be lost by it.
#pragma once

#include <string_view>

#include "view/viewer/state/session.h"

namespace palpate::viewer {

/// Whether the request throws changes away and has not been asked about; then the session asks, and it waits in there.
bool mustAskFirst(const Request& request, Session& session);

/// The answer to the session's question that a key means, or none.
std::string_view answerOf(window::Key key, const Session& session);

/// The window's title: what is open, and a star when there is something to save.
std::string titleOf(const Session& session);

}  // namespace palpate::viewer
