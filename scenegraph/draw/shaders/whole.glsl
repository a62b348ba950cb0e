// Of what is of one level.
void keep_own_share() {}
