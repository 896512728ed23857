// Gives the core what a usual system has: files, threads, readers of foreign mesh files, and the user's folders of made
// bodies and solved lumps.
#pragma once

namespace palpate {

/// Before the program reads a file or builds a world, and before any other thread runs; a second call changes nothing.
/// Programs that link the installed palpate::palpate by CMake have it called while they start
/// (engine/host/start_host.cpp). Without a host the core reads no file (it throws Error), works on the caller's thread
/// and makes each body again.
void installHost();

}  // namespace palpate
