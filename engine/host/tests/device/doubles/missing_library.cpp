// What a double needs and no loader finds: it stands for a part of a driver that was not installed.
extern "C" {
void palpateMissingLibrary() {}
}
