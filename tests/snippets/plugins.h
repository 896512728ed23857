/* What docs/howto/plugins.md takes for given. */
#include <stddef.h>

int probe(const char* which, char* reason, uint32_t reason_room, char* remedy, uint32_t remedy_room);
palpate_device_handle openArm(const char* which, char* reason, uint32_t room);
void closeArm(palpate_device_handle device);
int capabilities(palpate_device_handle device, struct palpate_device_capabilities* able);
int readPlace(palpate_device_handle device, struct palpate_device_reading* reading);
int writeForce(palpate_device_handle device, const double force_n[3]);
void explain(palpate_device_handle device, char* text, uint32_t room);
