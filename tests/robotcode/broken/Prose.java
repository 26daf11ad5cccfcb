Dear coach, my laptop broke and I could not finish exercise 4.
Please give me until Friday; the elevator works, I promise.
