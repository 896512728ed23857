// placeholder
namespace palpate::classroom {}
