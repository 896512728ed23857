"""Attacks on what listens: `--device remote` (UDP) and `palpate serve` (HTTP and WebSocket), as somebody on the network or
another user of the computer would try them."""
import contextlib
import hashlib
import hmac
import json
import os
import re
import socket
import time

import lab

TOKEN = "control-0123456789abcdef"
KEY = "00112233445566778899aabbccddeeff"
GATE = "engine/host/palpate/device/detail/remote_gate.cpp"
DEVICE = "engine/host/palpate/device/detail/remote_device.cpp"
BOOK = "engine/cli/serve/visit_book.cpp"
VISIT = "engine/cli/serve/http_visit.cpp"


# --- remote

def udp():
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.bind(("127.0.0.1", 0))
    return link


def collected(link, seconds, until=None):
    """The datagrams of so many seconds; `until` ends it early."""
    got = []
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0 and not (until and until(got)):
        link.settimeout(left)
        with contextlib.suppress(socket.timeout, ConnectionRefusedError):
            got.append(link.recv(512))
    return got


def start_remote(room, which, key=None):
    """A run in real time whose finger moves by datagrams."""
    env = dict(os.environ, HOME=str(room.folder))
    if key:
        file = room.folder / "remote.key"
        file.touch(mode=0o600)
        file.write_text(key + "\n")
        env["PALPATE_REMOTE_KEY_FILE"] = str(file)
    return room.start(room.palpate, "simulate", "--seconds", "600", "--realtime", "--no-pictures", "--no-plot", "--device",
                      f"remote:{which}", "--out", "felt", env=env)


def until_answered(room, link, to, message, seconds=12.0):
    """Sends until something comes back; what came, or None."""
    end = time.monotonic() + min(seconds, room.left())
    while time.monotonic() < end:
        link.sendto(message() if callable(message) else message, to)
        if got := collected(link, 0.05, until=bool):
            return got
    return None


def signed(text, key=KEY):
    return f"{text} {hmac.new(key.encode(), text.encode(), hashlib.sha256).hexdigest()}".encode()


def hello(key=KEY):
    return signed(f"hello {os.urandom(16).hex()}", key).ljust(192)


class Signer:
    """A client that has the key."""

    def __init__(self, room, port):
        self.link, self.to, self.number = udp(), ("127.0.0.1", port), 0
        got = until_answered(room, self.link, self.to, hello)
        if not got:
            raise RuntimeError("a hello with the right key is not answered")
        self.nonce = got[0].split()[2].decode()

    def pose(self, z=0.0):
        self.number += 1
        return signed(f"p 0 0 {z} {self.nonce} {self.number}")

    def send(self, message):
        self.link.sendto(message, self.to)


@lab.attack("remote-reflection", "network", [lab.Mend(GATE, "if (!holder_ || answers_left_ == 0) return {};", "if (!holder_) return {};")],
            seconds=40)
def reflection(room):
    """One datagram of 7 bytes, to be answered for ever."""
    port = room.free_port(socket.SOCK_DGRAM)
    start_remote(room, port)
    client = udp()
    if not until_answered(room, client, ("127.0.0.1", port), b"p 0 0 0"):
        return lab.broken("nothing answered an honest client")
    for _ in range(200):  # the servo has started when answers come
        client.sendto(b"p 0 0 0", ("127.0.0.1", port))
        time.sleep(0.002)
    collected(client, 0.5)
    time.sleep(1.2)  # the finger is free
    victim = udp()
    victim.sendto(b"p 0 0 0", ("127.0.0.1", port))
    answers = collected(victim, 2.0)
    return lab.judged(0 < len(answers) <= 22, f"7 bytes brought {len(answers)} answers, {sum(map(len, answers))} bytes, in 2 s")


@lab.attack("remote-second-sender", "network", [lab.Mend(GATE, "if (holder_ && from != *holder_) {", "if (false) {")], seconds=40)
def second_sender(room):
    """A second sender, to take the finger from the one that has it."""
    port = room.free_port(socket.SOCK_DGRAM)
    start_remote(room, port)
    to = ("127.0.0.1", port)
    owner, thief = udp(), udp()
    if not until_answered(room, owner, to, b"p 0 0 0"):
        return lab.broken("nothing answered an honest client")
    stolen = kept = 0
    for _ in range(300):
        owner.sendto(b"p 0 0 0", to)
        thief.sendto(b"p 0 0 -30", to)
        time.sleep(0.003)
        kept += len(collected(owner, 0.0005))
        stolen += len(collected(thief, 0.0005))
    return lab.judged(stolen == 0 and kept > 0, f"300 poses of a second sender: {stolen} answers to it, {kept} to the first")


@lab.attack("remote-open-address", "network", [lab.Mend(DEVICE, "if (isOnThisMachine(listen)) return", "if (isOnThisMachine(listen) || file == nullptr) return")],
            seconds=30)
def open_address(room):
    """An address that other computers reach, opened without a key."""
    port = room.free_port(socket.SOCK_DGRAM)
    result = room.run("simulate", "--seconds", "1", "--realtime", "--no-pictures", "--no-plot", "--device", f"remote:0.0.0.0:{port}",
                      "--out", "felt", seconds=15.0)
    words = result.stderr.decode(errors="replace")
    refused = result.returncode not in (0, None) and "PALPATE_REMOTE_KEY_FILE" in words
    return lab.judged(refused, f"exit code {result.returncode}: {words.strip().splitlines()[-1][:120] if words.strip() else 'no word'}")


@lab.attack("remote-readable-key", "network", [lab.Mend(GATE, "requireClosedFile(file);", "")], seconds=30)
def readable_key(room):
    """A key file that other users of the computer may read."""
    file = room.folder / "open.key"
    file.write_text(KEY)
    file.chmod(0o644)
    result = room.run("devices", "--json", env=dict(os.environ, PALPATE_REMOTE_KEY_FILE=str(file)))
    rows = json.loads(result.stdout)
    rows = rows["devices"] if isinstance(rows, dict) and "devices" in rows else rows
    remote = next(row for row in (rows if isinstance(rows, list) else rows.values()) if "remote" in json.dumps(row) and "available" in row)
    return lab.judged(remote["available"] is False and "chmod 600" in remote["reason"], f"mode 644: {remote['reason'] or 'taken'}"[:140])


@lab.attack("remote-forged", "network",
            [lab.Mend(GATE, "if (!equalInConstantTime(signature, {expected.data(), expected.size()})) return std::nullopt;",
                      "if (signature.size() != expected.size()) return std::nullopt;")], seconds=40)
def forged(room):
    """Poses and hellos without the key, with another, and with a place changed on the way."""
    port = room.free_port(socket.SOCK_DGRAM)
    start_remote(room, port, KEY)
    signer = Signer(room, port)
    stranger = udp()
    changed = signer.pose().replace(b"p 0 0 0.0", b"p 0 0 -30")
    wrong = "f" * 32
    for message in [b"p 0 0 -30", changed, signed(f"p 0 0 -30 {signer.nonce} 9", wrong), hello(wrong), b"hello".ljust(192)] * 20:
        stranger.sendto(message, signer.to)
        time.sleep(0.002)
    answers = collected(stranger, 1.0)
    return lab.judged(not answers, f"100 forged datagrams of 5 kinds: {len(answers)} answers")


@lab.attack("remote-replay", "network", [lab.Mend(GATE, "|| number <= pose_number_) return {};", ") return {};"),
                                         lab.Mend(GATE, "  holder_.reset();\n  beginConversation();\n", "  holder_.reset();\n")], seconds=40)
def replay(room):
    """Recorded poses of who has the key, sent again: at once, and when the finger is free."""
    port = room.free_port(socket.SOCK_DGRAM)
    start_remote(room, port, KEY)
    signer = Signer(room, port)
    recorded = [signer.pose() for _ in range(400)]
    for message in recorded:
        signer.send(message)
        time.sleep(0.003)
    honest = len(collected(signer.link, 0.3))
    if honest == 0:
        return lab.broken("nothing answered the honest client")
    for message in recorded:
        signer.send(message)
        time.sleep(0.0005)
    at_once = len(collected(signer.link, 0.3))
    time.sleep(1.3)
    thief = udp()
    for message in recorded + [signer.pose() for _ in range(50)]:  # the last were never sent: held back on the way
        thief.sendto(message, signer.to)
        time.sleep(0.0005)
    later = len(collected(thief, 0.5))
    return lab.judged(at_once + later == 0, f"{honest} honest answers; 400 replayed at once: {at_once}; 450 after the silence: {later}")


# --- serve

def start_serve(room, *words):
    """The port of a served small body."""
    dome = room.folder / "dome.obj"
    size, step = 21, 10.0
    lines = [f"v {x * step - 100} {y * step - 100} {20 - ((x * step - 100) ** 2 + (y * step - 100) ** 2) / 2000}"
             for y in range(size) for x in range(size)]
    for y in range(size - 1):
        for x in range(size - 1):
            a = y * size + x + 1
            lines += [f"f {a} {a + 1} {a + size + 1}", f"f {a} {a + size + 1} {a + size}"]
    dome.write_text("\n".join(lines) + "\n")
    site = room.folder / "site"
    (site / "big").mkdir(parents=True)
    (site / "index.html").write_text("<!doctype html><head></head><title>page</title>")
    (site / "big" / "bytes.bin").write_bytes(os.urandom(1 << 24))
    room.start(room.palpate, "serve", "dome.obj", "--port", "0", "--json", "--site", "site", "--token", TOKEN, *words, log="serve.txt")
    log = room.folder / "serve.txt"
    line = room.wait_for(lambda: re.search(r'^{"event":"serving".*}$', log.read_text(errors="replace"), re.M), seconds=20.0)
    if not line:
        raise RuntimeError("serve did not start: " + log.read_text(errors="replace")[-200:])
    return json.loads(line.group(0))


def wire(port, receive_bytes=None, patience=5.0):
    link = socket.socket()
    if receive_bytes:
        link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
    link.settimeout(patience)
    link.connect(("127.0.0.1", port))
    return link


def asked(port, path, lines="", patience=5.0):
    """The status of a request, and how long it took; 0 where none came."""
    began = time.monotonic()
    try:
        with wire(port, patience=patience) as link:
            link.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n{lines}\r\n".encode())
            head = link.recv(64)
            return int(head.split()[1]) if head else 0, time.monotonic() - began
    except OSError:
        return 0, time.monotonic() - began


def page_and_holder(port):
    page, page_s = asked(port, "/")
    state, state_s = asked(port, "/served/state", f"Authorization: Bearer {TOKEN}\r\n")
    return page == 200 and state == 200, f"page {page} after {page_s:.2f} s, with a token {state} after {state_s:.2f} s"


ROOM = lab.Mend(BOOK, "if (all <= limits_.strangers) return 0;", "return 0;")
REFUSED = lab.Mend("engine/cli/serve/network.cpp", "    beginVisit(std::move(socket), hall);\n",
                   "    if (hall.book.size() < 256) beginVisit(std::move(socket), hall);\n")


@lab.attack("serve-half-requests", "network", [ROOM, REFUSED], seconds=40)
def half_requests(room):
    """300 requests that never end, to keep everybody else out."""
    port = start_serve(room)["port"]
    with contextlib.ExitStack() as open_links:
        for _ in range(300):
            with contextlib.suppress(OSError):
                link = open_links.enter_context(wire(port))
                link.sendall(b"GET / HTTP/1.1\r\nHost: lo")
        time.sleep(0.3)
        held, seen = page_and_holder(port)
    return lab.judged(held, f"300 half requests: {seen}")


@lab.attack("serve-readers-that-read-nothing", "network", [ROOM, REFUSED], seconds=60)
def readers(room):
    """260 requests for 16 MB of which nothing is read, to keep everybody else out."""
    port = start_serve(room)["port"]
    with contextlib.ExitStack() as open_links:
        for _ in range(260):
            with contextlib.suppress(OSError):
                link = open_links.enter_context(wire(port, receive_bytes=2048))
                link.sendall(b"GET /big/bytes.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
        time.sleep(0.5)
        held, seen = page_and_holder(port)
    return lab.judged(held, f"260 readers that read nothing: {seen}")


@lab.attack("serve-one-reader-for-ever", "network", [lab.Mend(VISIT, "      line().expires_after(milliseconds(hall_.settings.piece_s));\n",
                                                             "      line().expires_never();\n")], seconds=60)
def one_reader(room):
    """A reader that takes nothing of an answer, to hold it for ever."""
    port = start_serve(room)["port"]
    with wire(port, receive_bytes=2048, patience=40.0) as link:
        link.sendall(b"GET /big/bytes.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
        began = time.monotonic()
        peer = link.getsockname()[1]
        # Established connections of the server to this port, as the kernel lists them.
        def served():
            return any(line.split()[2].endswith(f":{peer:04X}") and line.split()[3] == "01" and line.split()[1].endswith(f":{port:04X}")
                       for line in open("/proc/net/tcp").read().splitlines()[1:])
        present = served()
        gone = room.wait_for(lambda: not served(), seconds=20.0, step_s=0.2)
        took = time.monotonic() - began
    return lab.judged(present and gone, f"hung up on after {took:.1f} s" if gone else f"still served after {took:.1f} s")


@lab.attack("serve-bearer-letters", "network", [lab.Mend(VISIT, "!beast::iequals(scheme, {kBearer.data(), kBearer.size()})",
                                                        "scheme != beast::string_view(kBearer.data(), kBearer.size())")], seconds=30)
def bearer(room):
    """Forms of the Authorization line: right ones in any letters enter, all others do not."""
    port = start_serve(room)["port"]
    status = {form: asked(port, "/served/state", f"Authorization: {form}\r\n")[0]
              for form in [f"Bearer {TOKEN}", f"bearer {TOKEN}", f"BEARER  {TOKEN}", f"Bearer{TOKEN}", f"Basic {TOKEN}", TOKEN, "bearer",
                           f"bearer {TOKEN}x", f"bearer {TOKEN[:-1]}"]}
    right, wrong = list(status.values())[:3], list(status.values())[3:]
    return lab.judged(set(right) == {200} and set(wrong) == {401}, f"right forms {right}, wrong forms {wrong}")


@lab.attack("serve-plain-on-a-network", "network",
            [lab.Mend("engine/cli/serve/served_run.cpp", "if (!isLoopback(options.host) && options.tls_cert.empty()) say(", "if (options.port < 0) say("),
             lab.Mend("engine/cli/serve/network.cpp", 'if (!v6 && host != "0.0.0.0") return', "if (true) return")], seconds=30)
def plain(room):
    """Plain HTTP on every interface: without a word, under an address that no browser opens."""
    serving = start_serve(room, "--host", "0.0.0.0")
    words = (room.folder / "serve.txt").read_text(errors="replace")
    warned = "plain HTTP" in words
    usable = all("0.0.0.0" not in address for address in serving["addresses"] + [serving["address"]])
    return lab.judged(warned and usable, f"warning {'said' if warned else 'missing'}, addresses {', '.join(serving['addresses'])}")


def status_of(port, head):
    """The status that a request of these bytes gets; 0 where none came."""
    try:
        with wire(port) as link:
            link.sendall(head.encode())
            return int((link.recv(64).split() or [b"", b"0"])[1])
    except OSError:
        return 0


@lab.attack("serve-hosts", "network", [lab.Mend(VISIT, "if (!namesOneHost(request_)) return", "if (false && !namesOneHost(request_)) return")], seconds=30)
def hosts(room):
    """Requests with no Host, two, or one that is none: a proxy in front may have let another through."""
    port = start_serve(room)["port"]
    lines = {"none": "", "two": "Host: localhost\r\nHost: evil.example\r\n", "apart": "Host: localhost\r\nX: y\r\nhost: localhost\r\n",
             "empty": "Host:\r\n", "folded": "Host: local\r\n host\r\n", "path": "Host: localhost/a\r\n", "user": "Host: a@localhost\r\n",
             "ports": "Host: localhost:80:81\r\n", "bracket": "Host: [::1\r\n"}
    status = {name: status_of(port, f"GET / HTTP/1.1\r\n{line}Connection: close\r\n\r\n") for name, line in lines.items()}
    right = status_of(port, "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
    return lab.judged(right == 200 and set(status.values()) == {400}, f"localhost {right}, others {status}")


@lab.attack("serve-strange-name", "network",
            [lab.Mend(VISIT, "    if (isCrossOrigin()) {\n", "    if (hall_.port < 0) {\n")], seconds=30)
def strange_name(room):
    """A page under a name that leads here (DNS rebinding), which has the token from somewhere, to read the skin."""
    port = start_serve(room)["port"]
    evil, own = f"evil.example:{port}", f"127.0.0.1:{port}"

    def asked_as(host, *origins):
        lines = "".join(f"Origin: http://{origin}\r\n" for origin in origins)
        return status_of(port, f"GET /served/skin HTTP/1.1\r\nHost: {host}\r\n{lines}Authorization: Bearer {TOKEN}\r\nConnection: close\r\n\r\n")

    right = asked_as(own, own)
    status = [asked_as(evil, evil), asked_as(own, evil), asked_as(evil, own, evil), asked_as(evil, evil, own), asked_as(own, f"localhost.{evil}")]
    return lab.judged(right == 200 and set(status) == {403}, f"the own page {right}, strange ones {status}")
