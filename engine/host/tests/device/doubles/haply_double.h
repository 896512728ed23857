// A double of Haply's Inverse Service over two simulated arms: it listens on a port of this machine, in this process,
// for as long as that runs. It answers each message with one, as the real one does, so a test turns it by asking.
#pragma once

#include <string>

#include "host/tests/device/doubles/double_control.h"

namespace palpate::doubles {

/// What DoubleDevice::error means here. All but the first take the whole answer.
enum HaplyFault : unsigned {
  kNoState = 1,     ///< the device is listed and nothing is said of it
  kNoJson = 2,      ///< half an answer
  kCloses = 3,      ///< the service closes the connection
  kTooLong = 4,     ///< an answer of a megabyte
  kWrongTypes = 5,  ///< text where numbers are
  kSilent = 6,      ///< no answer while it lasts
  kNotANumber = 7,  ///< NaN, which JSON does not have
  kHuge = 8,        ///< a place a thousand kilometres away
  kNoDevices = 9,   ///< an answer about nothing
};

/// What DoubleControl::refusal means here.
enum HaplyRefusal : unsigned {
  kHangsUp = 1,      ///< whoever connects is left at once
  kNoWebSocket = 2,  ///< only pages, no WebSocket
  kOddSnapshot = 3,  ///< the first message is none
  kNoVersion = 4,    ///< no page tells the version
};

/// Starts it once a process.
DoubleControl& haplyControl();

/// "127.0.0.1:40123,http_port=40123", as PALPATE_HAPLY wants it.
std::string haplyWords();

/// Texts that came from clients since it was asked last, the newest last.
std::string lastHaplyOrder();

}  // namespace palpate::doubles
