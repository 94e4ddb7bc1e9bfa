// Nothing is to be filled before the lights are read.
void fill_lights()
{
}
